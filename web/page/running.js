/** Absorbers that are drawn. */
const DRAWN = 3;

/** The simulation that runs: at each absorber's place a box on its spring with the ball in it, beside the same place without
 *  absorbers; displacement over time, each ball between its walls with its impacts, and of one absorber the return map. */
function Running(engine, complain) {
  const WINDOW = 10, IMPACTS = 2000, SAMPLES = 48, FLASH = 0.12;
  // Points are [t, x_1, w_1, x_2, ...]: times in periods of the excitation, displacements in the page's unit, gaps over the clearance;
  // impacts [t, absorber, side]. What was largest so far, and what an axis ends at.
  let points = [], impacts = [], clock = 0, simulated = 0, begin = 0, last = null, shown = true, largest = 0, reach = 1, told = 0, audio = null, asks;
  let of = { clearances: [1], bare: null, places: [""], unit: "", scale: 1 };
  let paused = matchMedia("(prefers-reduced-motion: reduce)").matches;
  const all = () => of.clearances.length, drawn = () => Math.min(DRAWN, all()), width = () => 1 + 2 * all();
  const canvas = (label) => make("canvas", { role: "img", "aria-label": label });
  const scene = canvas("The structure at each absorber as a box on its spring with the ball in it, and dashed the same without absorbers");
  const motion = canvas("Displacement of the structure, with and without absorbers, and position of each ball between its walls over the last ten periods");
  const map = canvas("Return map: each time between impacts over the one before");
  const pause = make("button", { type: "button", onclick: () => { paused = !paused; label(); } });
  const label = () => { pause.textContent = paused ? "Run" : "Pause"; };
  const sound = make("button", { type: "button", "aria-pressed": "false", onclick: () => {
    audio = audio ? (audio.close(), null) : new AudioContext();
    sound.setAttribute("aria-pressed", String(Boolean(audio)));
  } }, "Sound");
  const speed = make("select", {}, ...[[0.5, "slow motion"], [2, "2 periods a second"], [10, "10 periods a second"], [200, "200 periods a second"]].map(([value, words]) =>
    make("option", { value, selected: value === 2 }, words)));
  const held = make("strong");
  const returns = make("details", {}, make("summary", {}, "Times between impacts"), map,
    make("p", { class: "live-note" }, "The time between impacts over the one before, in periods; two symmetric impacts per period are the point (0.5, 0.5), on the line of all motions with two impacts per period. From rest the absorber may stay inactive, which a push prevents."));
  label();
  this.figure = make("figure", { class: "live-running", "data-name": "running" },
    make("div", { class: "live-bar" }, pause, make("label", {}, make("span", {}, "Speed "), speed), sound,
      make("button", { type: "button", onclick: () => this.change(asks, "push") }, "With a push"),
      make("button", { type: "button", onclick: () => this.change(asks, "rest") }, "From rest")),
    make("div", { class: "live-canvases" }, scene, motion),
    make("figcaption", {}, held, "The full system, impact by impact; a slider changes it while it runs. A box is the structure where its absorber, the ball, sits; a wall that is hit turns red. The red arrow is the push of the ball on it, the arrow above the box the way that it moves: a push against that way brakes the structure. Grey and dashed: the same without absorbers."),
    returns);
  new IntersectionObserver(([one]) => { shown = one.isIntersecting; }).observe(scene);

  /** Runs a case on from where the simulation is, or anew: at rest, or with absorbers that were pushed. */
  this.change = (wanted, from, unseen = 0) => {
    asks = wanted;
    const answer = engine().ask({ ask: "run", ...wanted, from });
    if (answer.problems) return complain(answer.problems);
    const before = of;
    of = { ...answer, unit: answer.unit || (answer.places[0] ? "units" : "b") };
    held.textContent = of.carried;
    returns.hidden = all() > 1;
    if (from !== "here" || before.unit !== of.unit || before.clearances.length !== all()) { points = []; clock = simulated = largest = 0; }
    // Gaps of before are over other clearances.
    else for (let k = 0; k < points.length; k += width()) for (let j = 0; j < all(); j += 1) points[k + 2 + 2 * j] *= before.clearances[j] / of.clearances[j];
    reach = 0;
    for (let left = unseen; left > 0; left -= 40) engine().goOn(40, 1, width());
    begin = simulated - unseen;
    impacts = [];
    told = clock;
    if (paused) { clock += WINDOW; draw(); }
    if (last === null) last = requestAnimationFrame(frame);
  };
  this.state = () => ({ clock, impacts: impacts.length / 3, points: points.length / width(), reach });

  function ahead() {
    const periods = Math.min(40, Math.ceil(clock - simulated)), wide = width();
    if (periods > 0) {
      const news = engine().goOn(periods, SAMPLES, wide);
      for (let k = 0; k < news.points.length; k += wide) {
        points.push(begin + news.points[k]);
        for (let j = 0; j < all(); j += 1) {
          const x = news.points[k + 1 + 2 * j] * of.scale;
          points.push(x, news.points[k + 2 + 2 * j]);
          if (j < DRAWN) largest = Math.max(largest, Math.abs(x));
        }
      }
      for (let k = 0; k < news.impacts.length; k += 3) impacts.push(begin + news.impacts[k], news.impacts[k + 1], news.impacts[k + 2]);
      simulated += periods;
      clock = Math.min(clock, simulated);
      let first = 0;
      while (first < points.length && points[first] < clock - WINDOW) first += wide;
      points.splice(0, first);
      impacts.splice(0, Math.max(0, impacts.length - 3 * IMPACTS));
    }
    // The axis only grows, to a round number: a decay or a beating is seen as it is. What is far off it is said.
    const bare = of.bare ? Math.max(...of.bare.map((one) => Math.hypot(...one))) : 0, most = Math.max(largest, Math.min(bare, 4 * (largest + of.clearances[0])));
    if (most > reach) reach = round(1.05 * most);
  }
  const alone = (j, t) => of.bare[j][0] * Math.cos(2 * Math.PI * t) + of.bare[j][1] * Math.sin(2 * Math.PI * t);

  function frame(time) {
    const before = frame.time ? time - frame.time : 0;
    frame.time = time;
    if (!paused && shown) { clock += Math.min(before, 100) / 1000 * speed.value; draw(); }
    requestAnimationFrame(frame);
  }

  /** Room of a box and the words above it, and of a ball between its walls, which has more where it is the only one. */
  const ROW = 104, track = () => drawn() > 1 ? 74 : 100;

  function draw() {
    ahead();
    const style = getComputedStyle(motion);
    const [ink, soft, line, blue, red] = ["--ink", "--soft", "--line", "--link", "--bad"].map((name) => style.getPropertyValue(name));
    boxes(sheet(scene, drawn() > 1 ? ROW * drawn() + 10 : 186), { ink, soft, line, blue, red });
    strip(sheet(motion, 150 + track() * drawn()), { ink, soft, line, blue, red });
    if (map.clientWidth) square(sheet(map, 250), { soft, line, blue });
    click();
  }

  /** A click for the first impact since the last frame, where somebody wants to hear it. */
  function click() {
    let heard = false;
    for (let k = 0; k < impacts.length && !heard; k += 3) heard = impacts[k] > told && impacts[k] <= clock;
    told = clock;
    if (!audio || !heard || speed.value > 10) return;
    const now = audio.currentTime, tone = audio.createOscillator(), gain = audio.createGain();
    tone.frequency.value = 1400;
    gain.gain.setValueAtTime(0.12, now);
    gain.gain.exponentialRampToValueAtTime(0.001, now + 0.04);
    tone.connect(gain).connect(audio.destination);
    tone.start(now);
    tone.stop(now + 0.05);
  }

  /** The largest displacement of the last ten periods at an absorber. */
  function lately(j) {
    let most = 0;
    for (let k = 0; k < points.length && points[k] <= clock; k += width()) most = Math.max(most, Math.abs(points[k + 1 + 2 * j]));
    return most;
  }
  /** Whether something holds of an impact of an absorber since a time. */
  function some(j, since, holds = () => true) {
    for (let k = impacts.length - 3; k >= 0 && impacts[k] > since; k -= 3) if (impacts[k] <= clock && impacts[k + 1] === j && holds(impacts[k + 2])) return true;
    return false;
  }

  /** Displacement and gap of an absorber at the clock, between the points beside it, and which way the displacement goes. */
  function state(j) {
    const wide = width();
    let k = points.length - 2 * wide;
    while (k > 0 && points[k] > clock) k -= wide;
    if (k < 0) return [0, 0, 0];
    const part = Math.min(1, Math.max(0, (clock - points[k]) / (points[k + wide] - points[k] || 1)));
    const [x, gap] = [1, 2].map((i) => k + i + 2 * j);
    return [...[x, gap].map((i) => points[i] + part * (points[i + wide] - points[i])), Math.sign(points[x + wide] - points[x])];
  }

  function boxes({ g, width, height }, { ink, soft, line, blue, red }) {
    const half = 24, room = width - 70, size = room / (2 * reach + 2.6 * Math.max(...of.clearances)), middle = 60 + room / 2, only = drawn() === 1;
    const spring = (to, y) => {
      g.beginPath(); g.moveTo(6, y);
      for (let k = 0; k <= 12; k += 1) g.lineTo(14 + (to - 22) * k / 12, y + (k % 2 ? 6 : -6));
      g.lineTo(to, y); g.stroke();
    };
    const arrow = (from, y, way) => {
      g.beginPath(); g.moveTo(from, y); g.lineTo(from + 28 * way, y);
      g.moveTo(from + 20 * way, y - 5); g.lineTo(from + 28 * way, y); g.lineTo(from + 20 * way, y + 5); g.stroke();
    };
    /** A word that goes on from a place one way. */
    const word = (words, from, y, way) => { g.fillStyle = g.strokeStyle; g.textAlign = way > 0 ? "left" : "right"; g.fillText(words, from, y); g.textAlign = "left"; };
    g.lineWidth = 3; g.strokeStyle = soft;
    g.beginPath(); g.moveTo(6, 8); g.lineTo(6, height - 8); g.stroke();
    g.setLineDash([2, 4]); g.lineWidth = 1; g.strokeStyle = line;
    g.beginPath(); g.moveTo(middle, 6); g.lineTo(middle, height - 6); g.stroke();
    g.setLineDash([]);
    for (let j = 0; j < drawn(); j += 1) {
      const [x, gap, way] = state(j), y = 66 + ROW * j, b = of.clearances[j];
      // The cavity is to scale with the displacement, as far as a ball can be seen in it.
      const ball = Math.max(7, Math.min(15, 0.3 * size * b)), cavity = Math.max(size * b, 16), wide = cavity + ball;
      const at = (x) => Math.max(wide + 40, Math.min(width - wide - 4, middle + x * size));
      if (of.bare) {
        // The only one has room below.
        const ghost = at(alone(j, clock)), row = only ? 144 : y;
        g.setLineDash([6, 4]); g.strokeStyle = soft; g.lineWidth = 1.5;
        if (only) spring(ghost - wide, row);
        g.strokeRect(ghost - wide, row - half, 2 * wide, 2 * half);
        g.setLineDash([]);
      }
      g.lineWidth = 1.5; g.strokeStyle = soft;
      spring(at(x) - wide, y);
      g.lineWidth = 2; g.strokeStyle = ink;
      g.strokeRect(at(x) - wide, y - half, 2 * wide, 2 * half);
      for (const side of [-1, 1]) {
        if (!some(j, clock - Math.min(FLASH * speed.value, 0.24), (of) => of === -side)) continue;
        g.fillStyle = g.strokeStyle = red;
        g.fillRect(at(x) + side * wide - 4, y - half, 8, 2 * half);
        arrow(at(x) + side * (wide + 10), y, side);
        word("push", at(x) + side * (wide + 10), y - 9, side);
      }
      g.strokeStyle = ink;
      if (way) {
        arrow(at(x) + 4 * way, y - half - 9, way);
        word("moves", at(x), y - half - 5, -way);
      }
      g.fillStyle = blue;
      g.beginPath(); g.arc(at(x) - gap * cavity, y + half - ball - 1, ball, 0, 7); g.fill();
      words(j, y, only, width, soft, g);
    }
    // How long a round length is here.
    const length = round(40 / size), end = width - 10;
    g.strokeStyle = soft; g.lineWidth = 2;
    g.beginPath(); g.moveTo(end - length * size, height - 7); g.lineTo(end, height - 7); g.stroke();
    g.textAlign = "right"; g.fillText(`${number(length)} ${of.unit}`, end - length * size - 6, height - 3); g.textAlign = "left";
  }

  /** What is said above a box, and of one without absorbers. */
  function words(j, y, only, width, soft, g) {
    const small = width < 560, peak = of.bare ? Math.hypot(...of.bare[j]) : Infinity, idle = clock > WINDOW && !some(j, clock - WINDOW);
    const place = of.places[j], much = `±${number(lately(j))} ${of.unit}`;
    const bare = of.bare ? `±${number(peak)} ${of.unit}${peak > reach ? ", off this scale" : ""}` : "nothing limits it";
    const lasts = !small || only ? idle ? " now: no impacts" : " in these ten periods" : idle ? ", no impacts" : "";
    g.fillStyle = soft;
    if (only) {
      g.fillText(`${place && !small ? `${place}: ` : ""}with absorber, ${much}${lasts}`, 16, y - 50);
      g.fillText(of.bare ? `without, ${bare}` : `without: ${bare}`, 16, 110);
    } else g.fillText(`${small ? `${j + 1}` : `ball ${j + 1}, ${place}`}: ${much}${lasts}; without ${bare}`, 16, y - 50);
  }

  function strip({ g, width: wide, height }, { ink, soft, line, blue, red }) {
    const left = 74, right = wide - 6, from = clock - WINDOW, middle = 66, half = 54, step = width();
    const across = (t) => left + (t - from) / WINDOW * (right - left);
    const rule = (x1, y1, x2, y2) => { g.beginPath(); g.moveTo(x1, y1); g.lineTo(x2, y2); g.stroke(); };
    /** Three words at an axis: its upper end, its middle and its lower end. */
    const axis = (end, name, middle, half) => {
      g.fillStyle = soft; g.textAlign = "right";
      [[`+${number(end)}`, -1], [name, 0], [`−${number(end)}`, 1]].forEach(([word, share]) => g.fillText(word, left - 6, middle + share * half + 4));
    };
    /** What lies between two heights of the axis of time. */
    const inside = (top, bottom, act) => {
      g.save();
      g.beginPath(); g.rect(left, top, right - left, bottom - top); g.clip();
      act();
      g.restore();
    };
    const curve = (index, middle, half) => {
      g.strokeStyle = blue; g.lineWidth = 1.6; g.beginPath();
      for (let k = 0, pen = false; k < points.length && points[k] <= clock; k += step) {
        if (points[k] < from) continue;
        const x = across(points[k]), y = middle - points[k + index] * half;
        pen ? g.lineTo(x, y) : g.moveTo(x, y);
        pen = true;
      }
      g.stroke();
    };
    g.lineWidth = 1; g.strokeStyle = line;
    for (let t = Math.ceil(from); t <= clock; t += 1) rule(across(t), 6, across(t), height - 24);
    for (const share of [-1, 0, 1]) rule(left, middle - share * half, right, middle - share * half);
    axis(reach, of.unit, middle, half);
    g.fillText("time in periods", right, height - 6);
    inside(middle - half, middle + half, () => {
      if (!of.bare) return;
      g.setLineDash([5, 4]); g.strokeStyle = soft; g.lineWidth = 1.2; g.beginPath();
      for (let k = 0; k <= 480; k += 1) g.lineTo(across(from + k * WINDOW / 480), middle - alone(0, from + k * WINDOW / 480) / reach * half);
      g.stroke();
      g.setLineDash([]);
    });
    inside(0, height, () => curve(1, middle, half / reach));
    for (let j = 0; j < drawn(); j += 1) {
      const row = 128 + track() * (j + 0.5), side = track() / 2 - (drawn() > 1 ? 13 : 6);
      axis(of.clearances[j], drawn() > 1 ? `ball ${j + 1}` : "in the box", row, side);
      inside(0, height, () => {
        curve(2 + 2 * j, row, side);
        g.strokeStyle = ink; g.lineWidth = 2;
        for (const way of [-side, side]) rule(left, row + way, right, row + way);
        g.fillStyle = red;
        for (let k = 0; k < impacts.length; k += 3) {
          if (impacts[k + 1] !== j || impacts[k] < from || impacts[k] > clock) continue;
          g.beginPath(); g.arc(across(impacts[k]), row - side * impacts[k + 2], 3.5, 0, 7); g.fill();
        }
      });
    }
    g.textAlign = "left";
  }

  function square({ g, width, height }, { soft, line, blue }) {
    const side = Math.min(height - 48, width - 60), left = (width - side) / 2 + 10, top = 8, bottom = top + side;
    const pairs = [];
    for (let k = 6; k < impacts.length; k += 3) pairs.push([impacts[k - 3] - impacts[k - 6], impacts[k] - impacts[k - 3]]);
    const most = pairs.reduce((most, [a, b]) => Math.max(most, a, b), 1) * 1.05;
    const x = (t) => left + t / most * side, y = (t) => bottom - t / most * side;
    g.strokeStyle = line; g.lineWidth = 1.5;
    g.strokeRect(left, top, side, side);
    g.beginPath(); g.moveTo(x(0), y(1)); g.lineTo(x(1), y(0)); g.moveTo(x(0), y(0)); g.lineTo(x(most), y(most)); g.stroke();
    g.fillStyle = soft; g.textAlign = "center";
    g.fillText("time between impacts (periods)", left + side / 2, height - 6);
    g.fillText("0", left - 8, bottom + 4); g.fillText("1", x(1), bottom + 14); g.fillText("1", left - 8, y(1) + 4);
    g.save(); g.translate(left - 20, top + side / 2); g.rotate(-Math.PI / 2); g.fillText("the next one", 0, 0); g.restore();
    g.textAlign = "left";
    g.fillStyle = blue;
    for (const [a, b] of pairs) g.fillRect(x(a) - 1.5, y(b) - 1.5, 3, 3);
  }
}

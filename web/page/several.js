/** The page of a case of several modes or absorbers: what is known at the frequency of the sliders, and the figure over the range of the
 *  load, which that frequency does not change. */
function Several(page) {
  let ranged = "", skipped = false;
  const { figures, sliders, board } = page;
  const range = () => { const { text, at, narrow } = page.request(); return JSON.stringify([text, at?.load, at?.amplitude, narrow]); };
  this.open = () => { ranged = ""; };
  this.moved = () => {};

  this.follow = (_, study) => {
    if (range() !== ranged) {
      old(board);
      skipped = page.moving();
      if (!skipped) drawRange();
    }
    page.ask(page.desks()[1], "study", study);
  };
  /** What waited for the end of a movement. */
  this.rest = () => { if (skipped) drawRange(); };

  async function drawRange() {
    skipped = false;
    const wanted = ranged = range(), answer = await page.desks()[0].ask({ ask: "range", ...page.request() });
    if (wanted !== range()) return;
    fresh(board);
    const drawn = answer.figures ?? [], names = drawn.map(({ name }) => name);
    for (const [name, figure] of figures) if (!names.includes(name)) { figure.remove(); figures.delete(name); }
    drawn.forEach(page.draw);
  }

  /** The sentence about what was found, and the motions. */
  this.said = ({ markdown, tone }) => {
    const [said, ...others] = blocks(markdown, "Long-term motions"), [{ unit }] = page.controls();
    const heading = make("h2", {}, `Every long-term motion that was found at ${sliders.get("frequency").field.value} ${unit.symbol}`);
    return { tone, first: said.childNodes, rest: [heading, ...others] };
  };
}

/** The bytes of a text with seven bits a character, as page.py writes it: a character beyond them says which of three that a page cannot
 *  hold, and the next seven bits. */
function bytesOf(text) {
  const bytes = new Uint8Array(2 * text.length);
  let length = 0, held = 0, bits = 0;
  const take = (seven) => {
    [held, bits] = [held << 7 | seven, bits + 7];
    if (bits < 8) return;
    bits -= 8;
    bytes[length] = held >> bits;
    length += 1;
    held &= (1 << bits) - 1;
  };
  for (let k = 0; k < text.length; k += 1) {
    const code = text.charCodeAt(k);
    if (code >= 128) take([0, 13, 60][(code >> 7) - 1]);
    take(code & 127);
  }
  return bytes.subarray(0, length);
}

/** What LZMA has packed, with lc=3, lp=0, pb=0 and without a header, into so many bytes: browsers unpack nothing that packs as well. */
function unlzma(packed, size) {
  const out = new Uint8Array(size);
  // Where each kind of probability begins.
  const MATCH = 0, REP = 12, FIRST = 24, SECOND = 36, THIRD = 48, LONG = 60, SLOT = 72, FOOT = 328, ALIGN = 456, LENGTH = 472, LENGTH_OF_REP = 746, LITERAL = 1020;
  const chances = new Uint16Array(LITERAL + (0x300 << 3)).fill(1024);
  // Numbers of 32 bits without a sign are fast in an array: [range, code].
  const coder = Uint32Array.of(0xffffffff, new DataView(packed.buffer, packed.byteOffset).getUint32(1)), last = new Uint32Array(4);
  let at = 0, next = 5, state = 0;
  const shift = () => {
    if (coder[0] >= 0x1000000) return;
    coder[0] <<= 8;
    coder[1] = coder[1] << 8 | packed[next];
    next += 1;
  };
  const bit = (k) => {
    const chance = chances[k], bound = (coder[0] >>> 11) * chance, is = coder[1] >= bound;
    if (is) {
      coder[0] -= bound;
      coder[1] -= bound;
      chances[k] -= chance >> 5;
    } else {
      coder[0] = bound;
      chances[k] += 2048 - chance >> 5;
    }
    shift();
    return +is;
  };
  const tree = (begin, count) => {
    let node = 1;
    for (let k = 0; k < count; k += 1) node = node << 1 | bit(begin + node);
    return node - (1 << count);
  };
  const backward = (begin, count) => {
    let node = 1, value = 0;
    for (let k = 0; k < count; k += 1) {
      const one = bit(begin + node);
      node = node << 1 | one;
      value |= one << k;
    }
    return value;
  };
  const lengthOf = (begin) => !bit(begin) ? 2 + tree(begin + 2, 3) : !bit(begin + 1) ? 10 + tree(begin + 10, 3) : 18 + tree(begin + 18, 8);
  const distance = (length) => {
    const slot = tree(SLOT + 64 * Math.min(length - 2, 3), 6), count = (slot >> 1) - 1;
    if (slot < 4) return slot;
    const begin = (2 | slot & 1) << count;
    if (slot < 14) return begin + backward(FOOT + begin - slot, count);
    let value = 0;
    for (let k = 4; k < count; k += 1) {
      coder[0] >>>= 1;
      const is = coder[1] >= coder[0];
      if (is) coder[1] -= coder[0];
      value = value << 1 | is;
      shift();
    }
    return begin + (value << 4) + backward(ALIGN, 4);
  };
  while (at < size) {
    if (!bit(MATCH + state)) {
      const begin = LITERAL + 0x300 * ((at ? out[at - 1] : 0) >> 5);
      let node = 1;
      // After a match the byte that would have gone on with it tells what this one is not.
      for (let match = out[at - last[0] - 1], same = state >= 7; same && node < 256; match <<= 1) {
        const expected = match >> 7 & 1, one = bit(begin + (1 + expected << 8) + node);
        node = node << 1 | one;
        same = one === expected;
      }
      while (node < 256) node = node << 1 | bit(begin + node);
      out[at] = node;
      at += 1;
      state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
      continue;
    }
    let length = 1, which = 0;
    if (!bit(REP + state)) {
      length = lengthOf(LENGTH);
      last.copyWithin(1, 0, 3);
      last[0] = distance(length);
      state = state < 7 ? 7 : 10;
    } else {
      // One of the last four distances, which is the last one then.
      if (bit(FIRST + state)) which = bit(SECOND + state) ? 2 + bit(THIRD + state) : 1;
      const back = last[which];
      last.copyWithin(1, 0, which);
      last[0] = back;
      const isLong = which || bit(LONG + state);
      if (isLong) length = lengthOf(LENGTH_OF_REP);
      state = state < 7 ? isLong ? 8 : 9 : 11;
    }
    for (const end = at + length; at < end; at += 1) out[at] = out[at - last[0] - 1];
  }
  return out;
}

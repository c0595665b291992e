/**
 * The lines that two texts have in common, so that what remains is small: Myers (1986), "An O(ND) difference algorithm
 * and its variations", between anchors, which are lines that occur once in both texts (patience diff). A stretch with
 * more than `MAX_EDITS` edits between two anchors counts as replaced, so that rewriting all of a long file costs
 * nothing.
 *
 * Rejected: the npm package diff 8, of 8 kB gzipped, without anchors: 3.5 s where 4,000 rows have changed, and growing
 * by the square, or nothing at all above its limit; this takes 0.4 s for 100,000 rows.
 */

const MAX_EDITS = 1000;

/**
 * Index in `b` of each line of `a`, ascending; -1 for one that `b` doesn't have there.
 *
 * @param a numbers that stand for lines, equal for equal lines
 */
export function commonLines(a: Int32Array, b: Int32Array): Int32Array {
  const found = new Int32Array(a.length).fill(-1);
  new Matching(a, b, found).match(0, a.length, 0, b.length, true);
  moveDown(a, b, found);
  return found;
}

class Matching {
  constructor(
    private readonly a: Int32Array,
    private readonly b: Int32Array,
    private readonly found: Int32Array,
  ) {}

  match(fromA: number, toA: number, fromB: number, toB: number, seeksAnchors: boolean): void {
    const { a, b, found } = this;
    let [a0, a1, b0, b1] = [fromA, toA, fromB, toB];
    while (a0 < a1 && b0 < b1 && a[a0] === b[b0]) found[a0++] = b0++;
    while (a0 < a1 && b0 < b1 && a[a1 - 1] === b[b1 - 1]) found[--a1] = --b1;
    if (a0 === a1 || b0 === b1) return;
    const anchors = seeksAnchors ? this.anchors(a0, a1, b0, b1) : [];
    if (anchors.length === 0) {
      this.shortest(a0, a1, b0, b1);
      return;
    }
    for (const [i, j] of anchors) {
      this.match(a0, i, b0, j, false);
      found[i] = j;
      [a0, b0] = [i + 1, j + 1];
    }
    this.match(a0, a1, b0, b1, false);
  }

  /** The longest ascending list of lines that occur once on both sides. */
  private anchors(a0: number, a1: number, b0: number, b1: number): (readonly [number, number])[] {
    const inA = once(this.a, a0, a1);
    const inB = once(this.b, b0, b1);
    const pairs: (readonly [number, number])[] = [];
    for (const [line, i] of inA) {
      const j = inB.get(line);
      if (i >= 0 && j !== undefined && j >= 0) pairs.push([i, j]);
    }
    return ascending(pairs.sort(([i], [k]) => i - k));
  }

  /** Myers' greedy algorithm; nothing is found if it takes too many edits. */
  private shortest(a0: number, a1: number, b0: number, b1: number): void {
    const { a, b, found } = this;
    const [n, m] = [a1 - a0, b1 - b0];
    const most = Math.min(MAX_EDITS, n + m);
    const reached = new Int32Array(2 * most + 3);
    const mid = most + 1;
    /** How far each diagonal came, for each number of edits. */
    const traces: Int32Array[] = [];
    for (let edits = 0; edits <= most; edits++) {
      traces.push(reached.slice(mid - edits - 1, mid + edits + 2));
      for (let k = -edits; k <= edits; k += 2) {
        const isDown = k === -edits || (k !== edits && reached[mid + k - 1] < reached[mid + k + 1]);
        let x = isDown ? reached[mid + k + 1] : reached[mid + k - 1] + 1;
        while (x < n && x - k < m && a[a0 + x] === b[b0 + x - k]) x++;
        reached[mid + k] = x;
        if (x < n || x - k < m) continue;
        this.walkBack(traces, a0, b0, n, m);
        return;
      }
    }
    // Rewritten, but where the number of rows is the same some may be as they were.
    for (let i = 0; n === m && i < n; i++) if (a[a0 + i] === b[b0 + i]) found[a0 + i] = b0 + i;
  }

  private walkBack(traces: readonly Int32Array[], a0: number, b0: number, n: number, m: number): void {
    let [x, y] = [n, m];
    for (let edits = traces.length - 1; edits >= 0; edits--) {
      const before = traces[edits];
      const mid = edits + 1;
      const k = x - y;
      const isDown = k === -edits || (k !== edits && before[mid + k - 1] < before[mid + k + 1]);
      const from = edits === 0 ? 0 : isDown ? before[mid + k + 1] : before[mid + k - 1] + 1;
      while (x > from) {
        x--;
        y--;
        this.found[a0 + x] = b0 + y;
      }
      if (edits === 0) return;
      if (isDown) y--;
      else x--;
    }
  }
}

/** Each line that occurs, with its index; -1 if it occurs more than once. */
function once(lines: Int32Array, from: number, to: number): ReadonlyMap<number, number> {
  const found = new Map<number, number>();
  for (let i = from; i < to; i++) found.set(lines[i], found.has(lines[i]) ? -1 : i);
  return found;
}

/** The longest list of pairs that ascends by both numbers, out of one that ascends by the first. */
function ascending(pairs: readonly (readonly [number, number])[]): (readonly [number, number])[] {
  const ends: number[] = [];
  const before = new Int32Array(pairs.length);
  pairs.forEach(([, j], p) => {
    let low = 0;
    let high = ends.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (pairs[ends[middle]][1] < j) low = middle + 1;
      else high = middle;
    }
    before[p] = low > 0 ? ends[low - 1] : -1;
    ends[low] = p;
  });
  const found: (readonly [number, number])[] = [];
  for (let p = ends.at(-1) ?? -1; p >= 0; p = before[p]) found.push(pairs[p]);
  return found.reverse();
}

/**
 * Stretches that only one side has begin as late as possible: a block that was added after a similar one is then told
 * from its first line to its closing brace.
 */
function moveDown(a: Int32Array, b: Int32Array, found: Int32Array): void {
  for (let start = 0; start < a.length; start++) {
    if (found[start] >= 0) continue;
    let end = start;
    while (end < a.length && found[end] < 0) end++;
    // Of removed lines, the next line of b.
    let next = start > 0 ? found[start - 1] + 1 : 0;
    while (end < a.length && found[end] === next && a[start] === a[end]) {
      found[start++] = next++;
      found[end++] = -1;
    }
    start = end;
  }
  for (let i = 0; i < a.length; i++) {
    if (i > 0 && found[i - 1] < 0) continue;
    // Lines [from, to) of b were added before line i.
    let from = i > 0 ? found[i - 1] + 1 : 0;
    for (let to = found[i]; to > from && i < a.length && found[i] === to && b[from] === b[to]; to++)
      found[i++] = from++;
  }
}

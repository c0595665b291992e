/** Which labels are drawn: none over another, what is uncovered first, and of these the nearest. Allocates nothing. */

import type { ScreenBox } from '../overlay.ts';

/** CSS pixels. */
export const LINE_HEIGHT = 15;
/** Maximum number of labels at once. */
const LIMIT = 120;
/** Kept free on both sides. */
const ASIDE = 4;

/** The places that are taken, in CSS pixels of the viewport. */
export class LabelLayout {
  /** Left, top, right, bottom. */
  private readonly boxes = new Float32Array(4 * LIMIT);
  private readonly owners = new Int32Array(LIMIT);
  private count = 0;

  begin(): void {
    this.count = 0;
  }

  /** Keeps a box free of labels; left, top, right and bottom. */
  block([left, top, right, bottom]: ScreenBox): void {
    if (this.isFull) return;
    this.boxes.set([left, top, right, bottom], 4 * this.count);
    this.owners[this.count++] = -1;
  }

  get isFull(): boolean {
    return this.count >= LIMIT;
  }

  /** @param left of the first letter @param middle of the line */
  hasRoom(left: number, middle: number, width: number): boolean {
    if (this.isFull) return false;
    const { boxes } = this;
    const top = middle - LINE_HEIGHT / 2;
    for (let o = 0; o < 4 * this.count; o += 4) {
      const isApart =
        left > boxes[o + 2] || left + width < boxes[o] || top > boxes[o + 3] || top + LINE_HEIGHT < boxes[o + 1];
      if (!isApart) return false;
    }
    return true;
  }

  /** Call only if there is room. @param owner to be found by `ownerAt` */
  take(left: number, middle: number, width: number, owner = -1): void {
    const { boxes } = this;
    const o = 4 * this.count;
    boxes[o] = left - ASIDE;
    boxes[o + 1] = middle - LINE_HEIGHT / 2;
    boxes[o + 2] = left + width + ASIDE;
    boxes[o + 3] = middle + LINE_HEIGHT / 2;
    this.owners[this.count++] = owner;
  }

  /** The owner of the label at a point; −1 if there is none. */
  ownerAt(x: number, y: number): number {
    const { boxes, owners } = this;
    for (let b = 0; b < this.count; b++) {
      const o = 4 * b;
      const isInside = x >= boxes[o] && y >= boxes[o + 1] && x <= boxes[o + 2] && y <= boxes[o + 3];
      if (isInside && owners[b] >= 0) return owners[b];
    }
    return -1;
  }
}

/** Labels that compete for room, numbered from 0. */
export interface Candidates {
  readonly count: number;
  /** Of equal ones the first comes first. */
  depthOf(i: number): number;
  hasRoom(i: number): boolean;
  /** Whether something is in front of what it labels. Asked only where there is room. */
  isCovered(i: number): boolean;
  put(i: number, isCovered: boolean): void;
}

/** Chooses from at most so many candidates. */
export class LabelChoice {
  /** A binary heap, the nearest on top. */
  private readonly heap: Uint32Array;
  private readonly covered: Uint32Array;

  constructor(readonly capacity: number) {
    this.heap = new Uint32Array(capacity);
    this.covered = new Uint32Array(capacity);
  }

  /** Puts the uncovered ones that have room, nearest first; then the covered ones that still have. */
  choose(candidates: Candidates): void {
    const { heap, covered } = this;
    let left = Math.min(candidates.count, this.capacity);
    for (let i = 0; i < left; i++) heap[i] = i;
    for (let i = (left >> 1) - 1; i >= 0; i--) this.sink(candidates, i, left);
    let behind = 0;
    while (left > 0) {
      const nearest = heap[0];
      heap[0] = heap[--left];
      this.sink(candidates, 0, left);
      if (!candidates.hasRoom(nearest)) continue;
      if (candidates.isCovered(nearest)) covered[behind++] = nearest;
      else candidates.put(nearest, false);
    }
    for (let b = 0; b < behind; b++) if (candidates.hasRoom(covered[b])) candidates.put(covered[b], true);
  }

  private sink(candidates: Candidates, from: number, count: number): void {
    const { heap } = this;
    const moved = heap[from];
    let at = from;
    for (;;) {
      let child = 2 * at + 1;
      if (child >= count) break;
      if (child + 1 < count && isBefore(candidates, heap[child + 1], heap[child])) child++;
      if (!isBefore(candidates, heap[child], moved)) break;
      heap[at] = heap[child];
      at = child;
    }
    heap[at] = moved;
  }
}

function isBefore(candidates: Candidates, a: number, b: number): boolean {
  const one = candidates.depthOf(a);
  const other = candidates.depthOf(b);
  return one < other || (one === other && a < b);
}

import fc from 'fast-check';
import { expect, it } from 'vitest';
import { LabelChoice, LabelLayout, LINE_HEIGHT } from '../../../src/view/names/label-layout.ts';

interface Label {
  readonly left: number;
  readonly middle: number;
  readonly width: number;
  readonly depth: number;
  readonly isCovered: boolean;
}

const label: fc.Arbitrary<Label> = fc.record({
  left: fc.integer({ min: 0, max: 600 }),
  middle: fc.integer({ min: 0, max: 300 }),
  width: fc.integer({ min: 8, max: 120 }),
  depth: fc.double({ min: -1, max: 1, noNaN: true }),
  isCovered: fc.boolean(),
});

/** Chooses from `labels`; which were put, in order. */
function choose(labels: readonly Label[], layout = new LabelLayout()) {
  const put: { readonly i: number; readonly isCovered: boolean }[] = [];
  new LabelChoice(64).choose({
    count: labels.length,
    depthOf: (i) => labels[i].depth,
    hasRoom: (i) => layout.hasRoom(labels[i].left, labels[i].middle, labels[i].width),
    isCovered: (i) => labels[i].isCovered,
    put(i, isCovered) {
      layout.take(labels[i].left, labels[i].middle, labels[i].width, i);
      put.push({ i, isCovered });
    },
  });
  return put;
}

const overlap = (a: Label, b: Label) =>
  a.left < b.left + b.width && b.left < a.left + a.width && Math.abs(a.middle - b.middle) < LINE_HEIGHT;

it('labels never cover each other', () => {
  fc.assert(
    fc.property(fc.array(label, { maxLength: 64 }), (labels) => {
      const put = choose(labels);
      put.forEach(({ i }, n) => {
        for (const { i: other } of put.slice(0, n)) expect(overlap(labels[i], labels[other])).toBe(false);
      });
    }),
  );
});

it('labels of what is uncovered come first, and of these the nearest', () => {
  fc.assert(
    fc.property(fc.array(label, { maxLength: 64 }), (labels) => {
      const put = choose(labels);
      for (const { i, isCovered } of put) expect(isCovered).toBe(labels[i].isCovered);
      const order = put.map(({ i, isCovered }) => [Number(isCovered), labels[i].depth]);
      expect(order).toEqual([...order].sort(([a, near], [b, far]) => a - b || near - far));
      // None takes the room of a nearer one.
      const uncovered = choose(labels.filter((l) => !l.isCovered)).length;
      expect(put.filter(({ isCovered }) => !isCovered)).toHaveLength(uncovered);
    }),
  );
});

it('a label that is left out has no room', () => {
  fc.assert(
    fc.property(fc.array(label, { maxLength: 64 }), (labels) => {
      const layout = new LabelLayout();
      const put = choose(labels, layout).map(({ i }) => i);
      labels.forEach(({ left, middle, width }, i) => {
        if (!put.includes(i)) expect(layout.hasRoom(left, middle, width)).toBe(false);
      });
    }),
  );
});

it('a label is found at each of its points, and nowhere else', () => {
  const layout = new LabelLayout();
  layout.take(100, 50, 40, 7);
  layout.take(200, 50, 40);
  expect([layout.ownerAt(101, 50), layout.ownerAt(139, 56)]).toEqual([7, 7]);
  expect([layout.ownerAt(160, 50), layout.ownerAt(101, 70), layout.ownerAt(210, 50)]).toEqual([-1, -1, -1]);
  layout.begin();
  expect(layout.ownerAt(101, 50)).toBe(-1);
});

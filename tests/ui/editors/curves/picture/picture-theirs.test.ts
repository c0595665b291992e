import { describe, expect, it } from 'vitest';
import type { PictureColours } from '../../../../../src/ui/editors/curves/picture/picture-colours.ts';
import { drawTheirs } from '../../../../../src/ui/editors/curves/picture/picture-theirs.ts';
import type { TheirChannel } from '../../../../../src/ui/editors/curves/scene/their-channels.ts';
import { keyed, scene } from '../scenes.ts';

// Only these two are asked for.
const COLOURS = { theirs: 'theirs', wrong: 'wrong' } as PictureColours;

interface Drawn {
  readonly dots: { readonly colour: string; readonly x: number; readonly y: number; readonly radius: number }[];
  readonly lines: { readonly colour: string; readonly points: readonly (readonly [number, number])[] }[];
  readonly columns: { readonly colour: string; readonly x: number; readonly top: number; readonly height: number }[];
}

/** What is drawn of one channel over a line that is 0, on a plot of 400 × 200 pixels for seconds 0 … 4 and −1 … 1. */
function drawn(times: readonly number[], values: readonly number[], wrong: readonly number[]): Drawn {
  const channel: TheirChannel = {
    times: Float64Array.from(times),
    values: Float64Array.from(values),
    ours: new Float64Array(times.length),
    wrong: Uint8Array.from(wrong),
    largest: 0,
    firstWrong: undefined,
  };
  const out: Drawn = { dots: [], lines: [], columns: [] };
  let path: [number, number][] = [];
  let arcs: { x: number; y: number; radius: number }[] = [];
  const g = {
    fillStyle: '',
    strokeStyle: '',
    save: () => {},
    restore: () => {},
    rect: () => {},
    clip: () => {},
    beginPath: () => {
      path = [];
      arcs = [];
    },
    moveTo: (x: number, y: number) => void path.push([x, y]),
    lineTo: (x: number, y: number) => void path.push([x, y]),
    arc: (x: number, y: number, radius: number) => void arcs.push({ x, y, radius }),
    fill: () => void out.dots.push(...arcs.map((arc) => ({ colour: g.fillStyle, ...arc }))),
    stroke: () => void (path.length > 0 && out.lines.push({ colour: g.strokeStyle, points: path })),
    fillRect: (x: number, top: number, _width: number, height: number) =>
      void out.columns.push({ colour: g.fillStyle, x, top, height }),
  };
  const theirs = new Map([[0, channel]]);
  // As much of a context as is used.
  drawTheirs(g as unknown as CanvasRenderingContext2D, scene([keyed([[0, 0]])], { theirs }), COLOURS);
  return out;
}

/** Height of a value: the plot is 0 to 200 pixels. */
const yOf = (value: number) => 100 - 100 * value;

describe('another program’s channel over ours', () => {
  it('has a dot at each value, larger and red where it is wrong, and a line from there to ours', () => {
    const { dots, lines, columns } = drawn([0, 1, 2, 3], [0, 0.5, -0.5, 0], [0, 1, 1, 0]);
    const [right, wrong] = ['theirs', 'wrong'].map((colour) => dots.filter((dot) => dot.colour === colour));
    expect(right.map(({ x, y }) => [x, y])).toEqual([
      [0, yOf(0)],
      [300, yOf(0)],
    ]);
    expect(wrong.map(({ x, y }) => [x, y])).toEqual([
      [100, yOf(0.5)],
      [200, yOf(-0.5)],
    ]);
    expect(wrong[0].radius).toBeGreaterThan(right[0].radius);
    expect(lines[0]).toEqual({
      colour: 'wrong',
      points: [
        [100, yOf(0)],
        [100, yOf(0.5)],
        [200, yOf(0)],
        [200, yOf(-0.5)],
      ],
    });
    expect(columns).toEqual([]);
  });

  it('values that are no numbers are not drawn, nor lines to them', () => {
    const { dots, lines } = drawn([0, 1, 2, 3], [0, Number.NaN, 0, 0], [0, 1, 0, 0]);
    expect(dots.map(({ x }) => x)).toEqual([0, 200, 300]);
    expect(lines.map(({ points }) => points)).toEqual([
      [
        [200, yOf(0)],
        [300, yOf(0)],
      ],
    ]);
  });

  it('values closer than pixels are columns from the least to the largest, red if any is wrong', () => {
    const times = Array.from({ length: 4000 }, (_, i) => i / 1000);
    const values = times.map((_, i) => (i % 2 ? 0.5 : -0.5));
    const { dots, columns } = drawn(
      times,
      values,
      times.map((time) => (time >= 2 && time < 2.005 ? 1 : 0)),
    );
    expect(dots).toEqual([]);
    expect(columns).toHaveLength(400);
    expect(columns[10].top).toBeCloseTo(yOf(0.5) - 0.5, 6);
    expect(columns[10].height).toBeCloseTo(101, 6);
    expect(columns.filter(({ colour }) => colour === 'wrong').map(({ x }) => x)).toEqual([200]);
  });

  it('what is outside of the plot is not drawn, but for the lines that leave it', () => {
    const { dots } = drawn([-3, -2, -1, 1, 6, 7, 8], [0, 0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0, 0]);
    expect(dots.map(({ x }) => x)).toEqual([-100, 100, 600, 700]);
  });
});

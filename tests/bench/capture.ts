/** A made-up motion capture: every joint oscillates at its own pace. */

export interface CaptureSize {
  readonly joints: number;
  readonly frames: number;
  readonly frameSeconds: number;
}

export interface Capture {
  /** Per joint in the file's order; -1: the root. */
  readonly parents: readonly number[];
  /** x y z per joint. */
  readonly offsets: readonly number[];
  /** Per frame: x y z of the root, then degrees about z, x and y of each joint. */
  readonly rows: readonly (readonly number[])[];
  /** All of it as a `.bvh`. */
  readonly bvh: string;
}

/** The same for the same seed. */
export function capture(seed: number, { joints, frames, frameSeconds }: CaptureSize): Capture {
  const below = (j: number) => [2 * j + 1, 2 * j + 2].filter((k) => k < joints);
  const order: number[] = [];
  const visit = (j: number): string => {
    order.push(j);
    const positions = j === 0 ? '6 Xposition Yposition Zposition' : '3';
    const inside = below(j).length > 0 ? below(j).map(visit) : ['End Site\n{\nOFFSET 0 -5 0\n}'];
    const channels = `CHANNELS ${positions} Zrotation Xrotation Yrotation`;
    const body = [`OFFSET ${offsetOf(j).join(' ')}`, channels, ...inside].join('\n');
    return `${j === 0 ? 'ROOT' : 'JOINT'} joint${j}\n{\n${body}\n}`;
  };
  const hierarchy = visit(0);
  const rows = rowsOf(seed, 3 + 3 * joints, frames, frameSeconds);
  const motion = rows.map((row) => row.join(' ')).join('\n');
  return {
    parents: order.map((j) => order.indexOf(Math.floor((j - 1) / 2))),
    offsets: order.flatMap(offsetOf),
    rows,
    bvh: `HIERARCHY\n${hierarchy}\nMOTION\nFrames: ${frames}\nFrame Time: ${frameSeconds}\n${motion}\n`,
  };
}

const offsetOf = (j: number) => (j === 0 ? [0, 90, 0] : [j % 2 ? 6 : -6, j < 8 ? 12 : -7, 1]);

/** Up to 4° per frame, at 120 frames per second. */
function rowsOf(seed: number, width: number, frames: number, frameSeconds: number): number[][] {
  const random = noise(seed);
  const swings = Array.from({ length: width }, () => ({
    reach: 5 + 30 * random(),
    hertz: 0.2 + 1.8 * random(),
    phase: 2 * Math.PI * random(),
    middle: 40 * random() - 20,
  }));
  return Array.from({ length: frames }, (_, f) =>
    swings.map(({ reach, hertz, phase, middle }) => {
      const value = middle + reach * Math.sin(2 * Math.PI * hertz * f * frameSeconds + phase);
      return Number(value.toFixed(4));
    }),
  );
}

/** Pseudorandom numbers from 0 to 1, the same in every run. */
function noise(seed: number): () => number {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) | 0;
    return (state >>> 0) / 2 ** 32;
  };
}

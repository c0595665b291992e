/** Numbers with mistakes planted in them: what a program that makes them would print. */

import { runToEnd } from '../../src/evaluate/steps.ts';
import { type Character, shownTake } from '../../src/model/document.ts';
import { CATALOGUE } from '../../src/teaching/catalogue/all.ts';
import type { Variant } from '../../src/teaching/catalogue/mistake.ts';
import { type Comparison, compare } from '../../src/teaching/compare/compare.ts';
import type { ChannelTarget, FrameKind, Targets } from '../../src/teaching/compare/targets.ts';
import { channelValue } from '../../src/teaching/program/curve-rules.ts';
import { Evaluator } from '../../src/teaching/program/evaluator.ts';
import type { Program } from '../../src/teaching/program/program.ts';

export const VARIANTS: readonly { readonly code: string; readonly variant: Variant }[] = CATALOGUE.flatMap(
  ({ code, variants }) => variants.map((variant) => ({ code, variant })),
);

export type Kind = FrameKind | 'channels';

const NO_CHANNELS: ChannelTarget = {
  channels: new Uint32Array(0),
  times: new Float64Array(0),
  values: new Float64Array(0),
};

/** What can be dumped of a character. */
export function kindsOf(character: Character): readonly Kind[] {
  const take = shownTake(character);
  return [
    ...(character.skeleton ? (['world', 'local', 'positions'] as const) : []),
    ...(character.skins.length > 0 ? (['vertices', 'normals'] as const) : []),
    ...(take && !take.samples ? (['channels'] as const) : []),
  ];
}

/** A time at which most of the character moves; undefined without an animation. */
export function timeOf(character: Character): number | undefined {
  const take = shownTake(character);
  if (!take || !character.skeleton) return undefined;
  const { samples } = take;
  return samples ? samples.startSeconds + samples.frameSeconds * Math.min(5, samples.frameCount - 1) : 0.8;
}

/** A program's numbers, with six digits behind the point. */
export function numbersBy(character: Character, program: Program, kind: Kind): Targets {
  const take = shownTake(character);
  if (kind === 'channels') {
    const samples = (take?.channels ?? []).flatMap((channel, c) =>
      Array.from({ length: 24 }, (_, i) => ({ c, channel, time: -5.1 + 0.4737 * i })),
    );
    const value = samples.map(({ channel, time }) =>
      channelValue(channel, take?.range ?? [0, 1], time, program.curves),
    );
    return {
      frames: [],
      channels: {
        channels: Uint32Array.from(samples, ({ c }) => c),
        times: Float64Array.from(samples, ({ time }) => time),
        values: rounded(Float64Array.from(value)),
      },
    };
  }
  const time = timeOf(character);
  const found = new Evaluator(character).frame(program, time, { local: true, vertices: true, normals: true });
  const values = kind === 'positions' ? positionsOf(found.world) : found[kind];
  return { frames: [{ time, [kind]: rounded(values) }], channels: NO_CHANNELS };
}

export function positionsOf(world: Float64Array): Float64Array {
  return Float64Array.from({ length: (3 * world.length) / 16 }, (_, i) => world[16 * Math.floor(i / 3) + 12 + (i % 3)]);
}

function rounded(values: Float64Array): Float64Array {
  return values.map((value) => Number(value.toFixed(6)));
}

/** Numbers of several programs, each in a dump of its own: `0.txt`, `1.txt` … */
export function together(...dumps: readonly Targets[]): Targets {
  const frames = dumps.flatMap((dump) => dump.frames);
  const all = <K extends keyof ChannelTarget>(key: K) => dumps.flatMap(({ channels }) => Array.from(channels[key]));
  return {
    frames,
    channels: {
      channels: Uint32Array.from(all('channels')),
      times: Float64Array.from(all('times')),
      values: Float64Array.from(all('values')),
    },
    origins: {
      fileNames: dumps.map((_, d) => `${d}.txt`),
      frames: dumps.flatMap((dump, d) =>
        dump.frames.map(({ time: _, ...kinds }) => Object.fromEntries(Object.keys(kinds).map((kind) => [kind, d]))),
      ),
      samples: Uint32Array.from(dumps.flatMap(({ channels }, d) => Array.from(channels.channels, () => d))),
    },
  };
}

export function compared(character: Character, targets: Targets): Comparison {
  return runToEnd(compare(character, targets));
}

/** The codes that explain all numbers. */
export function namedIn({ causes }: Comparison): readonly string[] {
  return causes.filter(({ explains, of }) => explains === of).map(({ code }) => code);
}

/** Pseudorandom numbers from 0 to 1, the same in every run. */
export function* random(seed: number): Generator<number, never> {
  let state = seed;
  for (;;) {
    state = (Math.imul(state, 1664525) + 1013904223) | 0;
    yield (state >>> 0) / 2 ** 32;
  }
}

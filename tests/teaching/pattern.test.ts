/** How numbers differ that no known mistake explains, in words. */

import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { describe, expect, it } from 'vitest';
import type { Character } from '../../src/model/document.ts';
import { shownTake } from '../../src/model/document.ts';
import type { FrameTarget, Targets } from '../../src/teaching/compare/targets.ts';
import { characterOf } from '../../src/teaching/kit/answers.ts';
import { kitFiles } from '../../src/teaching/kit/files.ts';
import { channelValue, RIGHT_CURVES } from '../../src/teaching/program/curve-rules.ts';
import { RIGHT_PROGRAM } from '../../src/teaching/program/program.ts';
import { command } from '../helpers/command.ts';
import { characterFrom } from './lesson-files.ts';
import { compared, numbersBy, VARIANTS } from './planted.ts';

const tree = characterOf(['tree.skel', 'tree_sway.anim'], kitFiles());
const reed = characterOf(['reed.skel', 'reed.skin'], kitFiles());
const names = tree.skeleton?.joints.map(({ name }) => name) ?? [];
const at = (name: string) => names.indexOf(name);

/** Right numbers, changed. @param change of an item's numbers, by its index */
function changed(
  character: Character,
  kind: 'world' | 'positions' | 'vertices' | 'normals',
  change: (numbers: Float64Array, index: number) => void,
): Targets {
  const targets = numbersBy(character, RIGHT_PROGRAM, kind);
  const frame: FrameTarget = targets.frames[0];
  const values = frame[kind] ?? new Float64Array(0);
  const width = kind === 'world' ? 16 : 3;
  for (let o = 0; o < values.length; o += width) change(values.subarray(o, o + width), o / width);
  return targets;
}

const moveBy = (point: Float64Array, ...by: readonly number[]) => {
  by.forEach((d, k) => {
    point[k] += d;
  });
};

/** The same with positions, of which one joint's is off in x. */
function withPlaces(targets: Targets, joint: number, by: number): Targets {
  const [frame] = targets.frames;
  const [{ positions = new Float64Array(0) }] = numbersBy(tree, RIGHT_PROGRAM, 'positions').frames;
  positions[3 * joint] += by;
  return { ...targets, frames: [{ ...frame, positions }] };
}

describe('the pattern of joints and vertices', () => {
  it.each<[string, Targets, string]>([
    [
      'an offset of a branch',
      changed(tree, 'positions', (p, j) =>
        j === at('bough_r') || j > at('bough_r') ? moveBy(p, 0, 1.2, 0) : undefined,
      ),
      'Joint bough_r and all below it, by a constant offset (0, 1.2, 0).',
    ],
    [
      'an offset of all below a joint',
      changed(tree, 'positions', (p, j) => (j > at('bough_r') ? moveBy(p, 0.5, 0, -0.25) : undefined)),
      'All joints below bough_r, by a constant offset (0.5, 0, -0.25).',
    ],
    ['a scale', changed(tree, 'positions', (p) => p.set(p.map((v) => 100 * v))), 'All 6 joints, scaled by 100.'],
    ['a mirrored axis', changed(tree, 'positions', (p) => (p[0] = -p[0])), 'All 6 joints, mirrored in x.'],
    [
      'exchanged axes',
      changed(tree, 'positions', (p) => p.set([p[1], p[0], p[2]])),
      'All 6 joints, with x and y swapped.',
    ],
    [
      'one axis',
      changed(tree, 'positions', (p, j) => moveBy(p, 0.1 * (j + 1) ** 2)),
      'All 6 joints, only in x, by up to 3.6.',
    ],
    [
      'places of matrices',
      changed(tree, 'world', (m, j) => (j === 2 ? moveBy(m.subarray(12), 0, 0, 0.7) : undefined)),
      'Joint twig_l only, in places alone, by a constant offset (0, 0, 0.7).',
    ],
    [
      'rotations of matrices',
      changed(tree, 'world', (m, j) => (j === 2 || j === 5 ? m.copyWithin(0, 4, 7) : undefined)),
      '2 of 6 joints (twig_l, leaf_r), in rotations alone.',
    ],
    [
      'of several kinds, the one that differs',
      withPlaces(
        changed(tree, 'world', () => undefined),
        3,
        0.5,
      ),
      'Joint bough_r only, in places alone, by a constant offset (0.5, 0, 0).',
    ],
    [
      'what is no number',
      changed(tree, 'positions', (p, j) => (j === 3 ? p.fill(Number.NaN) : undefined)),
      'Joint bough_r only, of which some are not finite numbers.',
    ],
    [
      'all vertices',
      changed(reed, 'vertices', (p) => moveBy(p, 0.5, 0.25, 0)),
      'All 12 vertices, by a constant offset (0.5, 0.25, 0).',
    ],
  ])('is told: %s', (_, targets, words) => {
    const character = targets.frames[0].vertices ? reed : tree;
    const expected = words.replace('12 vertices', `${(targets.frames[0].vertices?.length ?? 0) / 3} vertices`);
    expect(compared(character, targets)).toMatchObject({ causes: [], pattern: expected });
  });
});

describe('the pattern of channels', () => {
  const KEYS = 'keys 3 { 0 0.1 smooth smooth 0.5 0.9 smooth smooth 1 -0.2 smooth smooth }';
  const character = characterFrom(
    'mine.anim',
    `animation { range 0 2 numchannels 4 ${['cycle cycle', 'bounce linear', 'constant cycle_offset', 'linear constant'].map((each) => `channel { extrapolate ${each} ${KEYS} }`).join(' ')} }`,
  );
  const take = shownTake(character);
  const times = Array.from({ length: 40 }, (_, i) => -1.47 + 0.1313 * i);
  const changedBy = (change: (value: number, time: number, channel: number, i: number) => number): Targets => {
    const samples = (take?.channels ?? []).flatMap((channel, c) =>
      times.map((time, i) => ({
        c,
        time,
        value: change(channelValue(channel, [0, 2], time, RIGHT_CURVES), time, c, i),
      })),
    );
    return {
      frames: [],
      channels: {
        channels: Uint32Array.from(samples, ({ c }) => c),
        times: Float64Array.from(samples, ({ time }) => time),
        values: Float64Array.from(samples, ({ value }) => value),
      },
    };
  };
  const right = (c: number, time: number) => {
    const channel = take?.channels[c];
    return channel ? channelValue(channel, [0, 2], time, RIGHT_CURVES) : Number.NaN;
  };

  it.each<[string, Targets, string]>([
    [
      'more each period',
      changedBy((v, t, c) => (c === 2 && t > 1 ? v + 0.9 * Math.floor(t) : v)),
      'Channel 2 only, after its last key, by 0.9 more each period.',
    ],
    [
      'a difference',
      changedBy((v, t, c) => (c === 1 && t < 0 ? v - 0.25 : v)),
      'Channel 1 only, before its first key, by -0.25.',
    ],
    [
      'more each second',
      changedBy((v, t, c) => (c === 3 && t < 0 ? v + 0.7 * t : v)),
      'Channel 3 only, before its first key, by 0.7 more each second.',
    ],
    ['a scale', changedBy((v) => 57.3 * v), 'All 4 channels, scaled by 57.3.'],
    ['a sign', changedBy((v, _, c) => (c === 0 || c === 3 ? -v : v)), 'Channels 0, 3 only, negated.'],
    [
      'a shift',
      changedBy((v, _, c, i) => (i === 0 ? v : right(c, times[i - 1]))),
      'All 4 channels, of the sample before.',
    ],
    [
      'a constant',
      changedBy((v, t, c) => (c === 0 && t >= 0 && t <= 1 ? 0.33 : v)),
      'Channel 0 only, between its keys, where all are 0.33.',
    ],
    [
      'one segment',
      changedBy((v, t, c) => (c === 1 && t > 0.5 && t < 1 ? v + Math.sin(7 * t) : v)),
      'Channel 1 only, between its keys at 0.5 and 1 s, by up to 0.956.',
    ],
    [
      'one sample',
      changedBy((v, _, c, i) => (c === 1 && i === 3 ? v + 0.5 : v)),
      `Channel 1 only, at ${times[3]} s alone, by 0.5.`,
    ],
  ])('is told: %s', (_, targets, words) => {
    expect(compared(character, targets)).toMatchObject({ causes: [], pattern: words });
  });

  it('is not told where all agrees, or where a mistake explains all', () => {
    expect(
      compared(
        character,
        changedBy((v) => v),
      ),
    ).not.toHaveProperty('pattern');
    const flat = VARIANTS.find(({ code }) => code === 'tangent-smooth-flat-ends')?.variant.apply(RIGHT_PROGRAM);
    const found = compared(character, numbersBy(character, flat ?? RIGHT_PROGRAM, 'channels'));
    expect(found.causes).toHaveLength(1);
    expect(found).not.toHaveProperty('pattern');
  });
});

describe('marrow compare', () => {
  it('tells the pattern, as text and as JSON', async () => {
    const folder = mkdtempSync(join(tmpdir(), 'marrow-'));
    try {
      writeFileSync(join(folder, 'a.skel'), 'balljoint root { offset 0 1 0 balljoint arm { offset 1 2 0 } }');
      writeFileSync(join(folder, 'mine.txt'), 'root 0 1.5 0\narm 1 3.5 0\n');
      const words = 'All 2 joints, by a constant offset (0, 0.5, 0).';
      const { out, code } = await command(['compare', 'a.skel', 'mine.txt'], folder);
      expect(code).toBe(1);
      expect(out).toContain(`explains these numbers.\nWhat differs: ${words}\n`);
      const json = await command(['compare', 'a.skel', 'mine.txt', '--json'], folder);
      expect(JSON.parse(json.out)).toMatchObject({ pattern: words });
    } finally {
      rmSync(folder, { recursive: true, force: true });
    }
  });
});

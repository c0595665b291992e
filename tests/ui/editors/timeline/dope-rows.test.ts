import { describe, expect, it } from 'vitest';
import type { Character } from '../../../../src/model/document.ts';
import { restChannel } from '../../../../src/model/takes/take.ts';
import { dofsFor } from '../../../../src/ui/editors/timeline/channels.ts';
import {
  allFolds,
  dopeRows,
  keyedChannels,
  MORPHS_FOLD,
  OTHERS_FOLD,
  ROOT_FOLD,
  type RowOptions,
  sameRows,
} from '../../../../src/ui/editors/timeline/dope-rows.ts';
import { morph } from '../../../helpers/builders.ts';
import { channel, character, skeleton, take } from '../../builders.ts';

/** Root translation 0–2, hips 3–5, knee 6–8, the morph "smile" 9. */
function wasp(...channels: Parameters<typeof take> extends [unknown, ...infer C] ? C : never): Character {
  return character({
    skeleton: skeleton(['hips', -1], ['knee', 0]),
    morphs: [morph('smile')],
    takes: [take([0, 1], ...channels)],
  });
}

const none = restChannel();
const key = channel(0.5);
const everyKeyed = wasp(...Array.from({ length: 10 }, () => key));

function rows(of: Character, options: Partial<RowOptions> = {}): string[] {
  const made = dopeRows(of, of.takes[0], { unfolded: [], all: false, filter: '', ...options });
  return made.map((row) => `${'  '.repeat(row.depth)}${row.label || row.kind}: ${row.channels.join(' ')}`);
}

it('lists the summary, the root translation, joints in the order of the skeleton, and the morphs last', () => {
  expect(rows(everyKeyed)).toEqual([
    'summary: 0 1 2 3 4 5 6 7 8 9',
    'Root translation: 0 1 2',
    'hips: 3 4 5',
    'knee: 6 7 8',
    'Morphs: 9',
  ]);
});

it('expands a group to its channels', () => {
  expect(rows(everyKeyed, { unfolded: [1, MORPHS_FOLD] })).toEqual([
    'summary: 0 1 2 3 4 5 6 7 8 9',
    'Root translation: 0 1 2',
    'hips: 3 4 5',
    'knee: 6 7 8',
    '  rx: 6',
    '  ry: 7',
    '  rz: 8',
    'Morphs: 9',
    '  smile: 9',
  ]);
});

describe('rows without keys', () => {
  const some = wasp(none, none, none, none, key, none, none, none, none, none);

  it('rows without keys are left out', () => {
    expect(rows(some, { unfolded: [0] })).toEqual(['summary: 4', 'hips: 4', '  ry: 4']);
  });

  it('rows without keys are listed on request', () => {
    expect(rows(some, { all: true, unfolded: [0] })).toEqual([
      'summary: 0 1 2 3 4 5 6 7 8 9',
      'Root translation: 0 1 2',
      'hips: 3 4 5',
      '  rx: 3',
      '  ry: 4',
      '  rz: 5',
      'knee: 6 7 8',
      'Morphs: 9',
    ]);
  });

  it('rows without keys are not in view', () => {
    expect(keyedChannels(some, '')).toEqual([4]);
  });

  it('leave nothing if no row is left, not even a summary', () => {
    expect(rows(wasp(none, none, none))).toEqual([]);
  });
});

describe('the filter', () => {
  it('the filter keeps a joint whose name matches, with all its channels', () => {
    expect(rows(everyKeyed, { filter: 'KNE' })).toEqual(['summary: 6 7 8', 'knee: 6 7 8']);
  });

  it('shows which channels of a joint match', () => {
    expect(rows(everyKeyed, { filter: 'knee ry' })).toEqual(['summary: 7', 'knee: 7', '  ry: 7']);
  });

  it('finds the same channel of every joint', () => {
    expect(rows(everyKeyed, { filter: 'rz' })).toEqual(['summary: 5 8', 'hips: 5', '  rz: 5', 'knee: 8', '  rz: 8']);
  });
});

it('names channels beyond the DOFs by number', () => {
  const long = wasp(...Array.from({ length: 12 }, () => key));
  expect(rows(long, { unfolded: [OTHERS_FOLD] }).slice(-3)).toEqual([
    'More channels: 10 11',
    '  channel 10: 10',
    '  channel 11: 11',
  ]);
});

it('ends with a short take’s last channel', () => {
  expect(rows(wasp(key, key, key, key))).toEqual(['summary: 0 1 2 3', 'Root translation: 0 1 2', 'hips: 3']);
});

it('lists everything that can be expanded', () => {
  expect(allFolds(everyKeyed, everyKeyed.takes[0])).toEqual([ROOT_FOLD, 0, 1, MORPHS_FOLD]);
});

it('selects the joint of a row, the root’s for its translation, and none for morphs', () => {
  const made = dopeRows(everyKeyed, everyKeyed.takes[0], { unfolded: [1], all: false, filter: '' });
  expect(made.map((row) => row.joint)).toEqual([undefined, 0, 0, 1, 1, 1, 1, undefined]);
});

it('keeps its rows when keys move, and not when a channel gets its first or loses its last', () => {
  const before = take([0, 1], key, none);
  expect(sameRows(before, take([0, 1], channel(0.6, 0.7), none))).toBe(true);
  expect(sameRows(before, take([0, 1], key, channel(0)))).toBe(false);
  expect(sameRows(before, take([0, 1], none, none))).toBe(false);
});

it('tells what is followed, on the joint too if it has nothing else', () => {
  const couples = ['rx', 'ry', 'rz'].map((dof) => ({ dof, joint: 0, follows: 'rx', gain: 1, offset: 0 }));
  const { skeleton: bones = skeleton(), takes } = everyKeyed;
  const coupledBy = (count: number) => {
    const joints = bones.joints.map((one, j) => (j === 1 ? { ...one, couples: couples.slice(0, count) } : one));
    const made = dopeRows({ ...everyKeyed, skeleton: { ...bones, joints } }, takes[0], {
      ...{ unfolded: [1], all: false, filter: 'knee' },
    });
    return made.map(({ label, follows }) => [label, follows]);
  };
  const each = ['rx', 'ry', 'rz'].map((dof) => [dof, 'hips rx']);
  expect(coupledBy(3)).toEqual([['', undefined], ['knee', 'hips rx'], ...each]);
  expect(coupledBy(1).slice(1)).toEqual([['knee', undefined], each[0], ['ry', undefined], ['rz', undefined]]);
});

describe('goals of limbs', () => {
  const goals = (limb: string) => ({ list: [{ limb, space: 'world', channels: {} }] });
  const moved = { ...take([0, 1], key), goals: goals('leg') };

  it('have their rows anew when a limb gets another name', () => {
    expect(sameRows(moved, { ...moved, goals: goals('leg') })).toBe(true);
    expect(sameRows(moved, { ...moved, goals: goals('left leg') })).toBe(false);
  });

  it('are listed as channels once, however often these are asked for', () => {
    const one = { ...everyKeyed, takes: [moved] };
    expect(dofsFor(one).at(-1)?.name).toBe('leg bend');
    expect(dofsFor({ ...one, name: 'another' })).toBe(dofsFor(one));
  });
});

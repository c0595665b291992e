import { beforeEach, describe, expect, it } from 'vitest';
import { setTangents } from '../../../../src/edit/commands/tangents.ts';
import type { ChannelKeys } from '../../../../src/model/session.ts';
import { TANGENT_CHOICES, type TangentChoice } from '../../../../src/model/takes/tangent-kinds.ts';
import { selectKeys } from '../../../../src/ui/editors/timeline/current-take.ts';
import { hasTangents, sideWithTangents } from '../../../../src/ui/editors/timeline/tangent-state.ts';
import { findAction, isChecked } from '../../../../src/ui/state/actions/action.ts';
import type { Workbench } from '../../../../src/ui/state/workbench.ts';
import { channel, character, documentOf, skeleton, take, workbench } from '../../builders.ts';

const ONE: readonly ChannelKeys[] = [{ channel: 0, indices: [0] }];
const BOTH: readonly ChannelKeys[] = [
  { channel: 0, indices: [0, 1] },
  { channel: 1, indices: [2] },
];

let wb: Workbench;
beforeEach(() => {
  const keyed = take([0, 2], channel(0, 1, 2), channel(0, 1, 2));
  ({ wb } = workbench(documentOf(character({ skeleton: skeleton(['hips', -1]), takes: [keyed] })), {}));
});

const make = (keys: readonly ChannelKeys[], kind: TangentChoice, side: 'in' | 'out' | 'both') =>
  wb.store.apply(setTangents, { characterId: 'c1', keys, side, kind });
/** Flat, linear, smooth, fixed, auto, step. */
const states = (side: 'in' | 'out' | 'both' = 'both') => TANGENT_CHOICES.map(({ name }) => hasTangents(wb, name, side));

describe('the kinds of tangents of the selected keys', () => {
  it('the kinds of tangents of the selected keys are none without keys', () => {
    expect(states()).toEqual([false, false, false, false, false, false]);
  });

  it('the kinds of tangents of the selected keys are told for each side, and mixed where sides differ', () => {
    make(ONE, 'smooth', 'in');
    make(ONE, 'linear', 'out');
    selectKeys(wb, ONE);
    expect(states('in')).toEqual([false, false, true, false, false, false]);
    expect(states('out')).toEqual([false, true, false, false, false, false]);
    expect(states()).toEqual([false, 'mixed', 'mixed', false, false, false]);
    expect((['flat', 'linear', 'smooth', 'fixed'] as const).map((kind) => sideWithTangents(wb, kind))).toEqual([
      undefined,
      'out',
      'in',
      undefined,
    ]);
    make(ONE, 'smooth', 'both');
    expect(states()).toEqual([false, false, true, false, false, false]);
    expect(sideWithTangents(wb, 'smooth')).toBeUndefined();
  });

  it('the kinds of tangents of the selected keys are mixed where keys differ, of one channel or of several', () => {
    make(BOTH, 'flat', 'both');
    selectKeys(wb, BOTH);
    expect(states()).toEqual([true, false, false, false, false, false]);
    make([BOTH[1]], 'fixed', 'in');
    selectKeys(wb, BOTH);
    expect(states()).toEqual(['mixed', false, false, 'mixed', false, false]);
    expect(sideWithTangents(wb, 'flat')).toBe('out');
    expect(sideWithTangents(wb, 'fixed')).toBeUndefined();
  });

  it('the kinds of tangents of the selected keys tick the actions of both sides and of each', () => {
    make(ONE, 'smooth', 'in');
    make(ONE, 'linear', 'out');
    selectKeys(wb, ONE);
    const ticked = (id: string) => {
      const action = findAction(wb, `timeline.tangents.${id}`);
      return action && isChecked(wb, action);
    };
    expect(['smooth', 'in.smooth', 'out.smooth', 'out.linear', 'flat'].map(ticked)).toEqual([
      'mixed',
      true,
      false,
      true,
      false,
    ]);
  });
});

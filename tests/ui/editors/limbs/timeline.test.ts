/** Goals of limbs in dope sheet, curves and inspector. */
import { expect, it } from 'vitest';
import { switchLimb } from '../../../../src/edit/commands/beside/limbs.ts';
import { shownKeys } from '../../../../src/evaluate/plot/shown-keys.ts';
import { listedChannels, takeInTimeline } from '../../../../src/ui/editors/timeline/channels.ts';
import { dopeRows } from '../../../../src/ui/editors/timeline/dope-rows.ts';
import { HERO, heroOf, LEG, run, withLegs } from '../../../edit/limbs/walker.ts';

const planted = run(withLegs(), switchLimb, { ...HERO, timeSeconds: 0.37, limb: 0, to: 'ik' });
const hero = heroOf(planted);
const take = takeInTimeline(hero);
const NO_FILTER = { list: 'selected', pinned: [], filter: '' } as const;

it('the dope sheet has a row for the goal of each limb that the take moves, with its curves below it', () => {
  if (!take) throw new Error('The walker has a take.');
  const rows = dopeRows(hero, take, { unfolded: [], all: false, filter: 'goal of leg_l' });
  expect(rows.map(({ kind, label, joint }) => ({ kind, label, joint }))).toEqual([
    { kind: 'summary', label: '', joint: undefined },
    { kind: 'goal', label: 'Goal of leg_l', joint: LEG[2] },
  ]);
  const open = dopeRows(hero, take, { unfolded: [rows[1].fold ?? 0], all: false, filter: 'goal of' });
  expect(open.slice(2).map(({ label, unit }) => `${label} ${unit}`)).toEqual([
    ...['blend weight', 'tx length', 'ty length', 'tz length', 'rx angle', 'ry angle', 'rz angle'],
    ...['px length', 'py length', 'pz length'],
  ]);
});

it('the curves of a limb’s joints are listed with those of its goal', () => {
  const of = (joint: number) =>
    listedChannels(hero, { characterId: 'c1', joint }, NO_FILTER).map(({ joint: name, dof }) =>
      `${name} ${dof}`.trim(),
    );
  expect(of(LEG[1])).toContain('leg_l goal ty');
  expect(of(0)).not.toContain('leg_l goal ty');
});

it('keys of goals are among those that the transport goes to', () => {
  const times = shownKeys(planted, { characterId: 'c1' }).flatMap((channel) => [...channel.times]);
  expect(times).toContain(0.37);
});

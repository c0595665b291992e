/** Keying goals of limbs that were moved by hand, with K and Shift+K, whatever the preview shows. */
import { expect, it } from 'vitest';
import { switchLimb } from '../../../../src/edit/commands/beside/limbs.ts';
import { setDofs } from '../../../../src/edit/commands/pose.ts';
import { goalValueAt } from '../../../../src/edit/limbs/goal-dofs.ts';
import { dofCountOf } from '../../../../src/evaluate/pose.ts';
import { steppedCharacter } from '../../../../src/evaluate/stepped-take.ts';
import type { Document } from '../../../../src/model/document.ts';
import { firstGoalChannel, withGoalChannels } from '../../../../src/model/takes/goals.ts';
import { keysOf } from '../../../../src/model/takes/take.ts';
import { putInSpace } from '../../../../src/ui/editors/limbs/edits.ts';
import { KEYING_ACTIONS } from '../../../../src/ui/editors/posing/keying-actions.ts';
import { setDisplay } from '../../../../src/ui/editors/viewport/actions.ts';
import { runAction } from '../../../../src/ui/state/actions/action.ts';
import { HERO, heroOf, LEG, run, withLegs, worldAt } from '../../../edit/limbs/walker.ts';
import { expectClose } from '../../../helpers/close.ts';
import { workbench } from '../../builders.ts';

const NOW = 0.73;
const planted = run(withLegs(), switchLimb, { ...HERO, timeSeconds: 0, limb: 0, to: 'ik' });
const count = dofCountOf(heroOf(planted));
const TY = firstGoalChannel(count, 0) + 2;
const stepped = (document: Document): Document => ({
  ...document,
  characters: document.characters.map(steppedCharacter),
});
const goalKeys = (document: Document) => keysOf(withGoalChannels(heroOf(document).takes[0], count).channels[TY]);

it.each([
  ['key.changed', false],
  ['key.changed', true],
  ['key.pose', false],
  ['key.pose', true],
])('%s keys a goal that was dragged, with the stepped preview: %s', (action, preview) => {
  expect(KEYING_ACTIONS.map(({ id }) => id)).toContain(action);
  const { wb } = workbench(planted, { timeSeconds: NOW });
  setDisplay(wb, { stepped: preview });
  const value = (goalKeys(planted).values[0] ?? 0) + 0.05;
  wb.store.apply(setDofs, { ...HERO, timeSeconds: NOW, dofs: [{ index: TY, value }] });
  expect(heroOf(wb.store.document).unkeyed?.dofs).toEqual([TY]);
  const shown = worldAt(preview ? stepped(wb.store.document) : wb.store.document, NOW);
  runAction(wb, action);
  const keyed = wb.store.document;
  expect(heroOf(keyed).unkeyed).toBeUndefined();
  const { times, values } = goalKeys(keyed);
  expect(values[times.indexOf(NOW)]).toBe(value);
  if (action === 'key.pose') {
    expectClose([...worldAt(keyed, NOW)], [...shown], 1e-9);
    expectClose([...worldAt(stepped(keyed), NOW)], [...shown], 1e-9);
  }
});

it('the stepped preview holds goals, too, up to their next key', () => {
  const first = goalKeys(planted).values[0];
  const dofs = [{ index: TY, value: first + 0.05 }];
  const raised = run(planted, setDofs, { ...HERO, timeSeconds: NOW, dofs, key: {} });
  const heldAt = (time: number) => goalValueAt(steppedCharacter(heroOf(raised)), TY, time);
  expect([0, 0.4, NOW - 0.01, NOW].map(heldAt)).toEqual([first, first, first, first + 0.05]);
});

it('another space is chosen for the goal from now on if it has keys, else for the whole take, and nothing moves', () => {
  const foot = 16 * LEG[2];
  const footAt = (document: Document, time: number) => [...worldAt(document, time).slice(foot, foot + 16)];
  const { wb } = workbench(planted, { timeSeconds: 0.3 });
  wb.store.select({ characterId: 'c1', joint: LEG[2] });
  const value = goalKeys(planted).values[0] + 0.02;
  wb.store.apply(setDofs, { ...HERO, timeSeconds: 0.3, dofs: [{ index: TY, value }] });
  const shown = footAt(wb.store.document, 0.3);
  putInSpace(wb, 'hips');
  const keyed = wb.store.document;
  expect(wb.store.undoLabel).toBe('Key limb leg_l');
  expect(heroOf(keyed).takes[0].goals?.list[0].space).toEqual([
    [-0.7, 'world'],
    [0.3, 'hips'],
  ]);
  expectClose(footAt(keyed, 0.3), shown, 1e-6);
  expectClose(footAt(keyed, 0), footAt(planted, 0), 1e-9);
  expect(heroOf(keyed).unkeyed).toBeUndefined();
  wb.store.undo();
  putInSpace(wb, 'world');
  expect(wb.store.undoLabel).not.toBe('Key limb leg_l');
});

it('without keys of the goal, its space is that of the whole take', () => {
  const { goals, ...rest } = heroOf(planted).takes[0];
  const [goal] = goals?.list ?? [];
  const channels = Object.fromEntries(
    Object.entries(goal.channels).map(([name, { curve }]) => [
      name,
      { curve: typeof curve === 'number' ? curve : curve.values[curve.values.length - 1] },
    ]),
  );
  const still = { ...rest, goals: { list: [{ ...goal, channels }] } };
  const document = { ...planted, characters: [{ ...heroOf(planted), takes: [still] }] };
  const { wb } = workbench(document, { timeSeconds: 0.3 });
  wb.store.select({ characterId: 'c1', joint: LEG[2] });
  putInSpace(wb, 'hips');
  expect(wb.store.undoLabel).toBe('Put leg_l into the space of hips');
  expect(heroOf(wb.store.document).takes[0].goals?.list[0].space).toBe('hips');
  expectClose([...worldAt(wb.store.document, 0.3)], [...worldAt(document, 0.3)], 1e-6);
});

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
import { KEYING_ACTIONS } from '../../../../src/ui/editors/posing/keying-actions.ts';
import { setDisplay } from '../../../../src/ui/editors/viewport/actions.ts';
import { runAction } from '../../../../src/ui/state/actions/action.ts';
import { HERO, heroOf, run, withLegs, worldAt } from '../../../edit/limbs/walker.ts';
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

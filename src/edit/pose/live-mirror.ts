/**
 * Live mirror: what is posed on one side is set on the other one, too, as *Copy to other side* would. Joints in the
 * middle are not touched.
 */
import { dofCountOf, poseAt } from '../../evaluate/pose.ts';
import type { Character, Document } from '../../model/document.ts';
import { coupleOf } from '../../model/skeleton/couples.ts';
import { characterDofs, type DofValue, firstDofs } from '../../model/skeleton/dofs.ts';
import type { Change } from '../change.ts';
import { requireCharacter } from '../characters.ts';
import type { Command } from '../command.ts';
import { type SetDofs, setDofs } from '../commands/pose.ts';
import { partnersPose } from './mirror.ts';

/** `pose.setDofs` while live mirror is on, which the page uses in place of that. */
export const mirroredSetDofs: Command<SetDofs, Document | Change> = {
  id: setDofs.id,
  label: (document, args) => setDofs.label(document, args),
  run(document, args) {
    const { characterId, dofs, timeSeconds } = args;
    const character = requireCharacter(document, characterId);
    const count = dofCountOf(character);
    const own = dofs.filter(({ index }) => index < count);
    // Of goals; of what is more, the command itself says that there is none.
    const ofGoals = dofs.filter(({ index }) => index >= count);
    return setDofs.run(document, { ...args, dofs: [...withPartners(character, own, timeSeconds), ...ofGoals] });
  },
};

/**
 * Values of DOFs with those of the joints on the other side.
 * @param timeSeconds of the transport: the pose that is displayed before the change
 */
function withPartners(character: Character, dofs: readonly DofValue[], timeSeconds: number): readonly DofValue[] {
  const { skeleton, morphs, clampsToLimits } = character;
  if (!skeleton) return dofs;
  const shown = new Float64Array(dofCountOf(character));
  poseAt(character, timeSeconds, shown);
  const all = characterDofs(skeleton, morphs);
  const after = shown.slice();
  for (const { index, value } of dofs) after[index] = value;
  const changed = dofs.filter(({ index }) => all[index].joint >= 0 && after[index] !== shown[index]);
  const sources = [...new Set(changed.map(({ index }) => all[index].joint))];
  const { joints, dofs: posed } = partnersPose(skeleton, after, clampsToLimits, sources);
  const given = new Set(dofs.map(({ index }) => index));
  const first = firstDofs(skeleton);
  const partners: DofValue[] = [];
  for (const joint of joints) {
    for (let d = first[joint]; all[d]?.joint === joint; d++) {
      if (posed[d] !== shown[d] && !given.has(d) && !coupleOf(skeleton, d))
        partners.push({ index: d, value: posed[d] });
    }
  }
  return partners.length > 0 ? [...dofs, ...partners] : dofs;
}

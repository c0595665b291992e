/** Rows of linked DOFs: what one follows, its gain and offset; and the way to link another. */
import type { ArgsOf } from '../../../edit/command.ts';
import { setCouple } from '../../../edit/commands/couples.ts';
import { findCharacter } from '../../../model/document.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { dofsOf } from '../../../model/skeleton/joint-types.ts';
import type { Couple, Dof, DofUnit, Skeleton } from '../../../model/skeleton/skeleton.ts';
import { attempt } from '../../state/actions/attempt.ts';
import { shownPerUnit, typedUnits, unitText, withoutNoise } from '../../state/joints/angles.ts';
import { pausePlayback } from '../../state/pause-playback.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element } from '../../widgets/dom.ts';
import { NumberField } from '../../widgets/numbers/number-field.ts';
import { shown } from '../../widgets/numbers/number-text.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { rigging } from './rigging-args.ts';
import type { SectionRow } from './section-rows.ts';

/** @param skeleton the rows are rebuilt when its joints or links change */
export function coupleRow(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>,
  characterId: string,
  skeleton: Skeleton,
  joint: number,
  dof: Dof,
): SectionRow & { readonly line: HTMLElement } {
  const { joints } = skeleton;
  const now = (): Couple | undefined =>
    findCharacter(wb.store.document, characterId)?.skeleton?.joints[joint]?.couples?.find((c) => c.dof === dof.name);
  const put = (follows: ArgsOf<typeof setCouple>['follows']) => {
    coupleIt(wb, characterId, { joint, dof: dof.name, follows });
    update();
  };
  const change = (part: Partial<{ joint: number; dof: string; gain: number; offset: number }>) => {
    const couple = now();
    if (couple) put({ joint: couple.joint, dof: couple.follows, gain: couple.gain, offset: couple.offset, ...part });
  };

  const whom = element('select', { 'aria-label': `Joint that ${dof.name} follows` });
  const followable = [...joints.keys()].filter((j) => dofsOf(joints[j].motion).length > (j === joint ? 1 : 0));
  for (const j of followable) whom.append(element('option', { value: String(j) }, jointName(skeleton, j)));
  const which = element('select', { 'aria-label': `DOF that ${dof.name} follows` });
  whom.addEventListener('change', () => {
    const other = Number(whom.value);
    const couple = now();
    const names = namesOf(skeleton, joint, dof, other);
    change({ joint: other, dof: couple && names.includes(couple.follows) ? couple.follows : names[0] });
  });
  which.addEventListener('change', () => change({ dof: which.value }));

  const { angles } = wb.settings.get();
  const to = shownPerUnit(dof.unit, angles);
  const from = () => shownPerUnit(followedUnit(skeleton, now()), angles);
  const refuse = (reason: string) => wb.messages.note(reason, 'warning');
  const gain = new NumberField({
    label: `Gain of ${dof.name}`,
    text: (value) => shown(value),
    commit: (value) => change({ gain: (value * from()) / to }),
    refuse,
    step: 0.1,
  });
  const offset = new NumberField({
    label: `Offset of ${dof.name}`,
    text: (value) => `${shown(value)}${unitText(dof.unit, angles)}`,
    commit: (value) => change({ offset: value / to }),
    refuse,
    step: 1,
    units: () => typedUnits(dof.unit, angles),
  });
  const update = () => {
    const couple = now();
    if (!couple) return;
    whom.value = String(couple.joint);
    setTooltip(whom, whom.selectedOptions[0]?.text ?? '');
    const names = namesOf(skeleton, joint, dof, couple.joint);
    which.replaceChildren(...names.map((name) => element('option', { value: name }, name)));
    which.value = couple.follows;
    gain.show(withoutNoise((couple.gain * to) / from()));
    offset.show(withoutNoise(couple.offset * to));
  };
  update();
  const remove = button(`Unlink ${dof.name}`, { class: 'plain' }, '×', () => put(null));
  const line = element(
    'div',
    { class: 'rig-couple' },
    element('div', { class: 'rig-row' }, element('span', { class: 'rig-label' }, `${dof.name} follows`), whom, which),
    element(
      'div',
      { class: 'rig-row is-second' },
      element('span', { class: 'unit', 'aria-hidden': 'true' }, '×'),
      gain.element,
      element('span', { class: 'unit', 'aria-hidden': 'true' }, '+'),
      offset.element,
      remove,
    ),
  );
  return { line, update };
}

/** Links one more DOF. Undefined if all are linked, or there is nothing to follow. */
export function addCoupleRow(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>,
  characterId: string,
  skeleton: Skeleton,
  joint: number,
): HTMLElement | undefined {
  const own = skeleton.joints[joint];
  const free = dofsOf(own.motion).filter(({ name }) => !own.couples?.some((couple) => couple.dof === name));
  if (!free.length) return undefined;
  const add = element('select', { 'aria-label': 'Link a DOF to another' });
  add.append(element('option', { value: '' }, 'Link DOF…'));
  for (const dof of free) add.append(element('option', { value: dof.name }, dof.name));
  add.addEventListener('change', () => {
    const dof = free.find(({ name }) => name === add.value);
    add.value = '';
    if (!dof) return;
    const found = firstToFollow(skeleton, joint, dof);
    if (!found) return wb.messages.note('There is no other DOF to link it to.');
    coupleIt(wb, characterId, { joint, dof: dof.name, follows: { ...found, gain: 1, offset: 0 } });
  });
  return element('div', { class: 'rig-row is-alone' }, add);
}

/** With the skin staying or following, as everything in this section. */
function coupleIt(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>,
  characterId: string,
  args: Pick<ArgsOf<typeof setCouple>, 'joint' | 'dof' | 'follows'>,
): void {
  pausePlayback(wb);
  attempt(wb.messages, () => wb.store.apply(setCouple, { ...rigging(wb, { id: characterId }), ...args }));
}

/** The parent's DOF of that name or unit, else the nearest ancestor's, else any that doesn't follow this one. */
function firstToFollow(
  skeleton: Skeleton,
  joint: number,
  dof: Dof,
): { readonly joint: number; readonly dof: string } | undefined {
  const { joints } = skeleton;
  const above: number[] = [];
  for (let j = joints[joint].parent; j >= 0; j = joints[j].parent) above.push(j);
  const others = [...joints.keys()].filter((j) => j !== joint && !above.includes(j));
  for (const other of [...above, ...others, joint]) {
    const dofs = dofsOf(joints[other].motion).filter(({ name }) => !follows(skeleton, other, name, joint, dof.name));
    const best = dofs.find(({ name }) => name === dof.name) ?? dofs.find(({ unit }) => unit === dof.unit) ?? dofs[0];
    if (best) return { joint: other, dof: best.name };
  }
  return undefined;
}

/** Whether a DOF is another, or follows it directly or indirectly. */
function follows(skeleton: Skeleton, joint: number, dof: string, otherJoint: number, otherDof: string): boolean {
  let at: { joint: number; dof: string } | undefined = { joint, dof };
  for (let steps = 0; at && steps <= skeleton.joints.length * 9; steps++) {
    if (at.joint === otherJoint && at.dof === otherDof) return true;
    const { joint: j, dof: name }: { joint: number; dof: string } = at;
    const couple: Couple | undefined = skeleton.joints[j].couples?.find((one) => one.dof === name);
    at = couple && { joint: couple.joint, dof: couple.follows };
  }
  return false;
}

/** DOFs of a joint that this one can follow: not itself. */
function namesOf(skeleton: Skeleton, joint: number, dof: Dof, other: number): string[] {
  const names = dofsOf(skeleton.joints[other].motion).map(({ name }) => name);
  return other === joint ? names.filter((name) => name !== dof.name) : names;
}

function followedUnit(skeleton: Skeleton, couple: Couple | undefined): DofUnit {
  const dofs = couple && dofsOf(skeleton.joints[couple.joint].motion);
  return dofs?.find(({ name }) => name === couple?.follows)?.unit ?? 'factor';
}

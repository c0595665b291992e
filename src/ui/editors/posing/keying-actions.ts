/** Actions that key the pose, and that create and remove takes. */

import { createTake, duplicateTake, removeTake, setTakeRange } from '../../../edit/commands/take.ts';
import { discardUnkeyed } from '../../../edit/commands/unkeyed.ts';
import { posedDofs } from '../../../edit/posed-dofs.ts';
import { rangeOfKeys } from '../../../edit/takes.ts';
import { unkeyedAt } from '../../../edit/unkeyed.ts';
import { dofCountOf } from '../../../evaluate/pose.ts';
import { silentChannels } from '../../../evaluate/retarget/moved-dofs.ts';
import { type Character, shownTake } from '../../../model/document.ts';
import { NEW_KEY_TANGENTS, TANGENTS } from '../../../model/takes/tangent-kinds.ts';
import { currentCharacter, selectedCharacters } from '../../state/actions/action.ts';
import { NO_JOINT, needs, needsSkeleton } from '../../state/actions/needs.ts';
import { keyNameOf } from '../../state/actions/tooltips.ts';
import { askForMoment } from '../../state/add-keys.ts';
import { allJointsText, selectedJointsOf } from '../../state/joints/selected-joint.ts';
import type { Action, Uses } from '../../state/workbench.ts';
import { shown } from '../../widgets/numbers/number-text.ts';
import { needsTake } from '../timeline/key-actions.ts';
import { deleteKeysNow, jointsOfEach, keyNow, keysNow, type OfCharacter, posesOfEach } from './pose-edits.ts';

const takeInView = (wb: Uses<'store'>) => {
  const character = currentCharacter(wb);
  return character && shownTake(character);
};

export const KEYING_ACTIONS: readonly Action[] = [
  {
    id: 'key.changed',
    label: 'Key changes (or the selected joints)',
    group: 'Keys',
    menu: 'Keys',
    shortcuts: ['K'],
    icon: 'key',
    refuses: needsSkeleton,
    run: keyChanged,
  },
  {
    id: 'key.pose',
    label: 'Key whole pose',
    group: 'Keys',
    menu: 'Keys',
    shortcuts: ['Shift+K'],
    refuses: needsSkeleton,
    run: (wb) => keyEach(wb, posesOfEach(wb)),
  },
  {
    id: 'key.joint',
    name: 'Key all DOFs of selected joints',
    label: (wb) => `Key all DOFs of ${allJointsText(wb)}`,
    group: 'Keys',
    menu: 'Keys',
    shortcuts: ['Ctrl+Alt+K'],
    refuses: needsSkeleton,
    run: (wb) => withJoints(wb, (each) => keyEach(wb, each)),
  },
  {
    id: 'key.forMoment',
    also: 'wave gesture ease',
    label: 'Key for a moment…',
    group: 'Keys',
    menu: 'Keys',
    refuses: needs(
      'There are no unkeyed changes at the current time: pose a joint first.',
      (wb) => unkeyedNow(wb).size > 0,
    ),
    run: (wb) =>
      withCharacter(wb, ({ id: characterId }) => {
        const dofs = [...unkeyedNow(wb)].map(([index, value]) => ({ index, value }));
        askForMoment(wb, { characterId, dofs }, wb.store.document, false);
      }),
  },
  {
    id: 'key.deleteHere',
    label: 'Delete keys at current time',
    group: 'Keys',
    menu: 'Keys',
    section: 1,
    shortcuts: ['Alt+K'],
    refuses: needs('There are no keys at the current time.', (wb) => hasKeysHere(wb)),
    run: (wb) => deleteKeysNow(wb, posesOfEach(wb)),
  },
  {
    id: 'key.deleteJointHere',
    name: 'Delete selected joints’ keys at current time',
    label: (wb) => `Delete keys of ${allJointsText(wb)} at current time`,
    group: 'Keys',
    menu: 'Keys',
    section: 1,
    shortcuts: ['Alt+Shift+K'],
    refuses: needs('There are no keys at the current time.', (wb) => hasKeysHere(wb)),
    run: (wb) => withJoints(wb, (each) => deleteKeysNow(wb, each)),
  },
  {
    id: 'key.dropUnkeyed',
    label: 'Discard unkeyed changes',
    group: 'Keys',
    menu: 'Keys',
    refuses: needs('There are no unkeyed changes.', (wb) =>
      wb.store.document.characters.some((c) => c.unkeyed !== undefined),
    ),
    run: (wb) => wb.store.apply(discardUnkeyed, { exceptSeconds: null }),
  },
  {
    id: 'key.auto',
    label: 'Auto-key',
    group: 'Keys',
    menu: 'Keys',
    section: 2,
    shortcuts: ['Alt+A'],
    icon: 'record',
    checked: (wb) => wb.timeline.autoKey.get(),
    run: (wb) => wb.timeline.autoKey.update((on) => !on),
  },
  ...NEW_KEY_TANGENTS.map((tangents): Action => {
    const label = TANGENTS.find(({ name }) => name === tangents)?.label ?? tangents;
    return {
      id: `key.tangents.${tangents}`,
      name: `Tangents of new keys: ${label.toLowerCase()}`,
      label: () => label,
      group: 'Keys',
      menu: 'Keys/Tangents of new keys',
      section: 2,
      radio: true,
      checked: (wb) => wb.settings.get().newKeyTangents === tangents,
      run: (wb) => wb.settings.update((s) => ({ ...s, newKeyTangents: tangents })),
    };
  }),
  {
    id: 'take.new',
    label: 'New take',
    group: 'Keys',
    menu: 'Keys/Take',
    section: 3,
    refuses: needsSkeleton,
    run: (wb) =>
      withCharacter(wb, (character) =>
        wb.store.apply(createTake, { characterId: character.id, range: playedRange(wb, character) }),
      ),
  },
  {
    id: 'take.duplicate',
    label: 'Duplicate take',
    group: 'Keys',
    menu: 'Keys/Take',
    section: 3,
    refuses: needsTake,
    run: (wb) => withCharacter(wb, ({ id }) => wb.store.apply(duplicateTake, { characterId: id })),
  },
  {
    id: 'take.rename',
    label: 'Rename take…',
    group: 'Keys',
    menu: 'Keys/Take',
    section: 3,
    refuses: needsTake,
    run: (wb) => wb.timeline.takeRenameAsked.update((times) => times + 1),
  },
  {
    id: 'take.remove',
    name: 'Remove take',
    label: (wb) => `Remove ${takeInView(wb)?.name ?? 'take'}`,
    group: 'Keys',
    menu: 'Keys/Take',
    section: 3,
    refuses: needsTake,
    run: (wb) => withCharacter(wb, ({ id }) => wb.store.apply(removeTake, { characterId: id })),
  },
  {
    id: 'take.rangeFromPlayed',
    also: 'save animation file start end',
    unchanged: 'The take already has that range.',
    label: 'Set take range to playback range',
    group: 'Keys',
    menu: 'Keys/Take',
    section: 4,
    refuses: needsTake,
    run: (wb) =>
      withCharacter(wb, (character) =>
        wb.store.apply(setTakeRange, { characterId: character.id, range: playedRange(wb, character) }),
      ),
  },
  {
    id: 'take.rangeFromKeys',
    unchanged: 'The take already has that range.',
    label: 'Fit take range to keys and samples',
    group: 'Keys',
    menu: 'Keys/Take',
    section: 4,
    refuses: needs('The take has no keys or samples.', (wb) => {
      const take = takeInView(wb);
      return take !== undefined && rangeOfKeys(take) !== undefined;
    }),
    run: (wb) =>
      withCharacter(wb, (character) => {
        const take = shownTake(character);
        const range = take && rangeOfKeys(take);
        if (range) wb.store.apply(setTakeRange, { characterId: character.id, range });
      }),
  },
];

function withCharacter(wb: Uses<'store'>, run: (character: Character) => void): void {
  const character = currentCharacter(wb);
  if (character) run(character);
}

/** A shortcut that silently does nothing without a selected joint would be confusing. */
function withJoints(wb: Uses<'store' | 'messages'>, run: (each: readonly OfCharacter[]) => void): void {
  const each = jointsOfEach(wb);
  if (each.length === 0) wb.messages.note(NO_JOINT);
  else run(each);
}

/** What was changed by hand; if nothing was, the selected joints as they are. Neither keys what nobody has touched. */
function keyChanged(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'actions' | 'messages'>,
): void {
  const character = currentCharacter(wb);
  if (!character) return;
  const { timeSeconds } = wb.transport.get();
  const posed = selectedCharacters(wb).flatMap((one) => {
    const dofs = posedDofs(one, wb.posing.opened.get(one.id), timeSeconds);
    return dofs.length ? { character: one, dofs } : [];
  });
  const each = posed.length ? posed : jointsOfEach(wb);
  if (each.length) {
    keyEach(wb, each);
    return;
  }
  // No selection would help: the command says what moves the character, and what to do.
  if (silentChannels(character) > 0) {
    keyEach(wb, [{ character }]);
    return;
  }
  const isCaptured = shownTake(character)?.channels.every(({ kind }) => kind === 'samples');
  const whole = isCaptured ? undefined : keyNameOf(wb, 'key.pose');
  wb.messages.note(
    `Nothing to key: no value was changed and no joint is selected. Rotate a joint, or select one${whole ? `; ${whole} keys the whole pose` : ''}.`,
  );
}

/** A key that is there already looks like one that was not made. */
function keyEach(
  wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>,
  each: readonly OfCharacter[],
): void {
  const some = each.filter(({ dofs }) => dofs?.length !== 0);
  if (some.length === 0) {
    const many = each.length > 1 || selectedJointsOf(wb, each[0].character.id).length > 1;
    wb.messages.note(many ? 'The selected joints have no DOFs to key.' : 'The selected joint has no DOFs to key.');
    return;
  }
  const before = wb.store.document;
  const isOffered = keyNow(wb, some);
  if (isOffered || wb.store.document !== before) return;
  wb.messages.note(`These values are already keyed at ${shown(wb.transport.get().timeSeconds)} s.`);
}

function unkeyedNow(wb: Uses<'store' | 'transport'>): ReadonlyMap<number, number> {
  const character = currentCharacter(wb);
  const all = character ? unkeyedAt(character, wb.transport.get().timeSeconds) : [];
  // As `keyForMoment`, which leaves goals of limbs unkeyed.
  const count = character ? dofCountOf(character) : 0;
  return new Map([...all].filter(([dof]) => dof < count));
}

function hasKeysHere(wb: Uses<'store' | 'transport'>): boolean {
  return selectedCharacters(wb).some((character) => keysNow(wb, character).length > 0);
}

/** In seconds of the character's takes. */
function playedRange(wb: Uses<'transport'>, { timeOffsetSeconds }: Character): readonly [number, number] {
  const [from, to] = wb.transport.get().range;
  return [from + timeOffsetSeconds, to + timeOffsetSeconds];
}

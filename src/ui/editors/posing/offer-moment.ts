/**
 * Keys of a pose over motion that goes on are abrupt: between keys of every frame they are a jump, within a cycle every
 * repetition shows them, and in a new layer they hold. A line says so, with a way to key the pose for a moment instead.
 */
import { changedCyclesOf, keyedEndsOf } from '../../../edit/keys/cycle.ts';
import { type Abrupt, abruptKey, keyedPose } from '../../../edit/keys/keyed-pose.ts';
import { type Character, findCharacter } from '../../../model/document.ts';
import { askForMoment } from '../../state/add-keys.ts';
import type { Uses } from '../../state/workbench.ts';
import { shown } from '../../widgets/numbers/number-text.ts';
import { channelName, namedChannel } from '../timeline/channels.ts';

type Parts = Uses<'store' | 'transport' | 'timeline' | 'messages'>;

/** Follows steps that key a pose until ended. */
export function followKeyedPoses(wb: Parts): () => void {
  const { store, messages } = wb;
  return store.onStep(({ document }, { document: before }) => {
    if (!store.undoLabel?.startsWith('Key ') && !wb.timeline.autoKey.get()) return;
    const { timeSeconds } = wb.transport.get();
    const pose = keyedPose(before, document, timeSeconds);
    const character = findCharacter(document, pose?.characterId);
    const abrupt = pose && character && abruptKey(character, pose.dofs, timeSeconds);
    if (!pose || !character || !abrupt) return;
    const was = findCharacter(before, character.id);
    // That the cycle itself has changed is said elsewhere.
    if (was && changedCyclesOf(was, character).length + keyedEndsOf(was, character).length > 0) return;
    messages.confirm(
      abruptText(character, abrupt),
      { label: 'Key for a moment…', run: () => askForMoment(wb, pose, before, true) },
      () => store.document !== document,
    );
  });
}

/** `This key is 0.033 s from the next: upper_arm_l rz will jump.` */
function abruptText(character: Character, abrupt: Abrupt): string {
  const name = channelName(namedChannel(character, abrupt.dof));
  if (abrupt.kind === 'holds') return `This is the layer’s only key of ${name}, so it is held at all times.`;
  const seconds = shown(abrupt.seconds);
  if (abrupt.kind === 'jumps') return `This key is ${seconds} s from the next: ${name} will jump.`;
  return `Every repeat shows this key: ${name} repeats every ${seconds} s.`;
}

/** Keeps pinned, hidden and isolated channels with their character. */
import type { State } from '../../../edit/history.ts';
import type { Character } from '../../../model/document.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import type { Uses } from '../../state/workbench.ts';
import { dofsFor } from './channels.ts';

/** Follows document and selection until ended. Start it before what draws the timeline. */
export function followCharacter(wb: Uses<'store' | 'timeline'>): () => void {
  const { store, timeline } = wb;
  const follow = () => {
    const character = currentCharacter(wb);
    if (character) timeline.showChannelsOf(character.id);
  };
  follow();
  return store.subscribe((now, before) => {
    forgetOthers(wb, now, before);
    follow();
  });
}

/** Undo may also bring back another skeleton, the one before a reload. */
function forgetOthers({ timeline }: Uses<'timeline'>, { document }: State, { document: before }: State): void {
  if (document === before) return;
  for (const was of before.characters) {
    const now = document.characters.find((c) => c.id === was.id);
    if (now && now !== was && !hasSameDofs(was, now)) timeline.forgetChannelsOf(now.id);
  }
}

/** Whether channel numbers mean the same for both. Limits, poses and offsets may differ. */
function hasSameDofs(a: Character, b: Character): boolean {
  if (a.skeleton === b.skeleton && a.morphs === b.morphs) return true;
  const [dofsOfA, dofsOfB] = [dofsFor(a), dofsFor(b)];
  return (
    dofsOfA.length === dofsOfB.length &&
    dofsOfA.every((dof, i) => dof.name === dofsOfB[i].name && dof.joint === dofsOfB[i].joint) &&
    (a.skeleton?.joints ?? []).every((joint, j) => joint.name === b.skeleton?.joints[j]?.name)
  );
}

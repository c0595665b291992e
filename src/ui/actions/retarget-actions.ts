/** Putting one character's take onto another. */
import { bakeRetarget, clearRetarget } from '../../edit/commands/retarget.ts';
import { possibleTargets } from '../retarget/targets.ts';
import { type Action, currentCharacter } from './action.ts';

export const RETARGET_ACTIONS: readonly Action[] = [
  {
    id: 'retarget.open',
    label: 'Put a take onto a character…',
    group: 'Edit',
    menu: 'Edit',
    section: 3,
    enabled: (wb) => possibleTargets(wb.store.document).length > 0,
    run: (wb) => wb.dialog.set('retarget'),
  },
  {
    id: 'retarget.bake',
    name: 'Bake the take that moves the character',
    label: (wb) => `Bake ${currentCharacter(wb)?.driver?.source.clip.name ?? 'what moves the character'}`,
    detail: 'As a take of the character’s own',
    group: 'Edit',
    menu: 'Edit',
    section: 3,
    enabled: (wb) => currentCharacter(wb)?.driver !== undefined,
    run(wb) {
      const character = currentCharacter(wb);
      if (character) wb.store.apply(bakeRetarget, { characterId: character.id });
    },
  },
  {
    id: 'retarget.clear',
    name: 'Take another character’s take off',
    label: (wb) => `Take off ${currentCharacter(wb)?.driver?.source.clip.name ?? 'what moves the character'}`,
    group: 'Edit',
    menu: 'Edit',
    section: 3,
    enabled: (wb) => currentCharacter(wb)?.driver !== undefined,
    run(wb) {
      const character = currentCharacter(wb);
      if (character) wb.store.apply(clearRetarget, { characterId: character.id });
    },
  },
];

/** Putting one character's take onto another. */
import { currentCharacter } from '../../state/action.ts';
import type { Action } from '../../state/workbench.ts';
import { possibleTargets } from './targets.ts';

const commands = () => import('../../../edit/commands/retarget.ts');

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
    async run(wb) {
      const { bakeRetarget } = await commands();
      const character = currentCharacter(wb);
      if (character) wb.store.apply(bakeRetarget, { characterId: character.id });
    },
  },
  {
    id: 'retarget.clear',
    name: 'Let go of the take that moves the character',
    label: (wb) => `Let go of ${currentCharacter(wb)?.driver?.source.clip.name ?? 'what moves the character'}`,
    detail: 'Its own take and pose again',
    group: 'Edit',
    menu: 'Edit',
    section: 3,
    enabled: (wb) => currentCharacter(wb)?.driver !== undefined,
    async run(wb) {
      const { clearRetarget } = await commands();
      const character = currentCharacter(wb);
      if (character) wb.store.apply(clearRetarget, { characterId: character.id });
    },
  },
];

/** Actions of retargeting. */

import { currentCharacter } from '../../state/actions/action.ts';
import { needs } from '../../state/actions/needs.ts';
import type { Action } from '../../state/workbench.ts';
import { possibleTargets } from './targets.ts';

const commands = () => import('../../../edit/commands/retarget.ts');

export const RETARGET_ACTIONS: readonly Action[] = [
  {
    id: 'retarget.open',
    name: 'Retarget take',
    label: (wb) => (currentCharacter(wb)?.driver ? 'Change retargeting…' : 'Retarget take…'),
    group: 'Edit',
    menu: 'Edit',
    section: 3,
    refuses: needs(
      'Open two characters with skeletons, one of them with a take.',
      (wb) => possibleTargets(wb.store.document).length > 0,
    ),
    run: (wb) => wb.dialog.set('retarget'),
  },
  {
    id: 'retarget.bake',
    name: 'Bake retargeting',
    label: (wb) => `Bake ${currentCharacter(wb)?.driver?.source.take.name ?? 'retargeting'}`,
    detail: 'As the character’s own take',
    group: 'Edit',
    menu: 'Edit',
    section: 3,
    refuses: needs('The character is not retargeted from another.', (wb) => currentCharacter(wb)?.driver !== undefined),
    async run(wb) {
      const { bakeRetarget } = await commands();
      const character = currentCharacter(wb);
      if (character) wb.store.apply(bakeRetarget, { characterId: character.id });
    },
  },
  {
    id: 'retarget.clear',
    name: 'Stop retargeting',
    label: (wb) => `Stop retargeting ${currentCharacter(wb)?.driver?.source.take.name ?? ''}`.trim(),
    detail: 'Returns to its own take and pose',
    group: 'Edit',
    menu: 'Edit',
    section: 3,
    refuses: needs('The character is not retargeted from another.', (wb) => currentCharacter(wb)?.driver !== undefined),
    async run(wb) {
      const { clearRetarget } = await commands();
      const character = currentCharacter(wb);
      if (character) wb.store.apply(clearRetarget, { characterId: character.id });
    },
  },
];

/** Actions on the shown skin. */

import { shownSkin } from '../../../model/document.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import type { Action, Uses } from '../../state/workbench.ts';

const skinOf = (wb: Uses<'store'>) => {
  const character = currentCharacter(wb);
  return character && shownSkin(character);
};

export const SKIN_ACTIONS: readonly Action[] = [
  {
    id: 'skin.weights',
    label: 'Automatic skin weights…',
    detail: 'Binds each vertex to the bones near it',
    group: 'Edit',
    menu: 'Edit',
    section: 4,
    alsoIn: { menu: 'Rig', section: 6 },
    refuses(wb) {
      const character = currentCharacter(wb);
      if (!character) return 'Open a character with a skeleton and a skin first.';
      if (character.skeleton && skinOf(wb)) return undefined;
      return `${character.name} has no ${character.skeleton ? 'skin' : 'skeleton'}.`;
    },
    explained: true,
    run: (wb) => wb.dialog.set('skinWeights'),
  },
];

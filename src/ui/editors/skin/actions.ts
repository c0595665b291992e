/** Actions on the shown skin. */

import { shownSkin } from '../../../model/document.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { needs } from '../../state/actions/needs.ts';
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
    enabled: needs(
      'Open a character with a skeleton and a skin first.',
      (wb) => skinOf(wb) !== undefined && currentCharacter(wb)?.skeleton !== undefined,
    ),
    whyNot(wb) {
      const character = currentCharacter(wb);
      if (!character) return undefined;
      return `${character.name} has no ${character.skeleton ? 'skin' : 'skeleton'}.`;
    },
    run: (wb) => wb.dialog.set('skinWeights'),
  },
];

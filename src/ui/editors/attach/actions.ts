/** Actions on what a character follows: its root is attached to a joint of another one. Edits are loaded on first use. */
import { shownTake } from '../../../model/document.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { needs } from '../../state/actions/needs.ts';
import { onDemand } from '../../state/on-demand.ts';
import type { Action, Uses, Workbench } from '../../state/workbench.ts';

async function edit(wb: Workbench, run: (edits: typeof import('./edits.ts')) => void): Promise<void> {
  const edits = await onDemand(wb.messages, 'Attaching', () => import('./edits.ts'));
  if (edits) run(edits);
}

const needsAttached = needs('The current character is not attached.', (wb: Uses<'store'>) => {
  const character = currentCharacter(wb);
  return character !== undefined && shownTake(character)?.attached !== undefined;
});

/** At its very end, too: it is keyed where it was then. */
const needsHeld = needs('It follows nothing at this time. Go to a time at which it does.', (wb: Workbench) => {
  const character = currentCharacter(wb);
  const time = wb.transport.get().timeSeconds + (character?.timeOffsetSeconds ?? 0);
  const list = (character && shownTake(character)?.attached?.list) ?? [];
  return list.some(({ span }) => span[0] <= time && time <= span[1]);
});

const OF_CHARACTER = { group: 'Edit', menu: 'Edit', section: 3 } as const;

export const ATTACH_ACTIONS: readonly Action[] = [
  {
    ...OF_CHARACTER,
    id: 'character.attach',
    label: 'Attach to…',
    refuses: needs(
      'Open two characters with skeletons first.',
      (wb) => wb.store.document.characters.filter(({ skeleton }) => skeleton).length > 1,
    ),
    run: (wb) => wb.dialog.set('attach'),
  },
  {
    ...OF_CHARACTER,
    id: 'character.putDown',
    label: 'Put down',
    refuses: (wb) => needsAttached(wb) ?? needsHeld(wb),
    run: (wb) => edit(wb, ({ putDownNow }) => putDownNow(wb)),
  },
  {
    ...OF_CHARACTER,
    id: 'character.detach',
    label: 'Detach',
    refuses: needsAttached,
    run: (wb) => edit(wb, ({ detachNow }) => detachNow(wb)),
  },
];

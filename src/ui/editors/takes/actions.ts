/** Actions on takes: playing one or needsSeveral, when and where. */

import type { Arrangement } from '../../../edit/commands/takes.ts';
import { needs } from '../../state/actions/needs.ts';
import { onDemand } from '../../state/on-demand.ts';
import { openPanel } from '../../state/panels/panels.ts';
import type { Action, TakeToolName, Uses, Workbench } from '../../state/workbench.ts';
import { isMac } from '../../widgets/focus/keyboard.ts';
import { endComparison } from './compared-takes.ts';
import { needsFrames, needsPlayedTake, needsTakesToEdit, needsTakesToJoin } from './edited.ts';
import {
  align,
  charactersMeant,
  chosenTakes,
  currentPlace,
  listOfTakes,
  needsTakes,
  playAlone,
  playTogether,
  putTakes,
  resetOffsets,
  showAll,
  stepTake,
  takesAtHand,
  toggleShown,
} from './play.ts';
import type { TakeRow } from './rows.ts';
import { takesToCompare } from './which-takes.ts';

const MENU = 'Play/Takes';
const EDIT_MENU = 'Edit/Edit takes';
const TWO_TAKES = `Select two takes in the Takes tab: ${isMac ? 'Cmd' : 'Ctrl'}+click the second. Or right-click one: Compare with.`;
const SEVERAL = 'This needs two characters with takes: select them in the Takes tab, or show all.';
const isComparing = (wb: Uses<'timeline'>) => wb.timeline.takes.comparison.get() !== undefined;
const needsSeveral = needs(SEVERAL, (wb: Uses<'store' | 'timeline'>) => charactersMeant(wb).length > 1);

export const TAKE_ACTIONS: readonly Action[] = [
  {
    id: 'take.next',
    label: 'Next take',
    group: 'Play',
    menu: 'Play',
    section: 4,
    shortcuts: ['PageDown', 'J'],
    repeats: true,
    refuses: needsTakes,
    run: (wb) => stepTake(wb, 1),
  },
  {
    id: 'take.previous',
    label: 'Previous take',
    group: 'Play',
    menu: 'Play',
    section: 4,
    shortcuts: ['PageUp', 'Shift+J'],
    repeats: true,
    refuses: needsTakes,
    run: (wb) => stepTake(wb, -1),
  },
  {
    id: 'take.list',
    label: 'Take list',
    group: 'Play',
    menu: MENU,
    section: 4,
    run(wb) {
      openPanel(wb, 'timeline', true);
      wb.timeline.change({ tab: 'takes' });
    },
  },
  {
    id: 'take.alone',
    label: 'Play this take alone',
    group: 'Play',
    menu: MENU,
    section: 5,
    icon: 'play',
    refuses: needsTakes,
    run(wb) {
      const rows = listOfTakes(wb);
      const [row = rows[Math.max(0, currentPlace(wb, rows))]] = chosenTakes(wb);
      if (row) playAlone(wb, row);
    },
  },
  {
    id: 'take.toggleShown',
    label: 'Show or hide take',
    group: 'Play',
    // H toggles the heat map elsewhere, and Space must play here too.
    panel: 'takes',
    shortcuts: ['H'],
    refuses: needs('Select a take first.', (wb) => takesAtHand(wb).length > 0),
    run: (wb) => toggleShown(wb, ...takesAtHand(wb)),
  },
  {
    id: 'take.together',
    label: (wb) => {
      const { length } = chosenTakes(wb);
      return length > 1 ? `Play these ${length} together` : 'Play selected takes together';
    },
    name: 'Play selected takes together',
    group: 'Play',
    menu: MENU,
    section: 5,
    refuses: needs('Select two takes or more first.', (wb) => chosenTakes(wb).length > 1),
    run: (wb) => playTogether(wb, chosenTakes(wb)),
  },
  {
    id: 'take.showAll',
    label: 'Show all characters',
    group: 'Play',
    menu: MENU,
    section: 5,
    refuses: needs('No character is hidden.', (wb) => wb.store.document.characters.some((c) => c.isHidden)),
    run: showAll,
  },
  {
    id: 'take.compare',
    label: (wb) => (wb.timeline.takes.comparison.get() ? 'Stop comparing' : 'Compare selected takes'),
    name: 'Compare two takes',
    group: 'Play',
    menu: MENU,
    section: 6,
    explained: true,
    refuses: needs(
      TWO_TAKES,
      (wb) => wb.timeline.takes.comparison.get() !== undefined || takesToCompare(wb) !== undefined,
    ),
    run(wb) {
      const pair = takesToCompare(wb);
      if (wb.timeline.takes.comparison.get()) endComparison(wb);
      else if (pair) return compare(wb, ...pair);
      return undefined;
    },
  },
  {
    id: 'take.alignStarts',
    label: 'Align starts',
    detail: 'Selected takes, or all visible ones',
    group: 'Play',
    menu: MENU,
    section: 7,
    refuses: needsTakes,
    run: align,
  },
  {
    id: 'take.resetOffsets',
    label: 'Original start times',
    detail: 'As in the files',
    group: 'Play',
    menu: MENU,
    section: 7,
    refuses: needsTakes,
    run: resetOffsets,
  },
  {
    ...put('grid', 'Side by side', 'In rows, without overlap'),
    refuses: needs(
      (wb: Uses<'store' | 'timeline'>) =>
        isComparing(wb) ? 'Takes are being compared. Stop comparing first.' : SEVERAL,
      (wb: Uses<'store' | 'timeline'>) => !isComparing(wb) && charactersMeant(wb).length > 1,
    ),
  },
  put('spot', 'Same spot', 'All start at the first one’s position'),
  put('space', 'Same space', 'All in the coordinates of the first one'),
  {
    id: 'take.mirror',
    label: 'Mirror',
    name: 'Mirror take',
    detail: 'Selected takes, or the current one',
    group: 'Play',
    menu: EDIT_MENU,
    section: 4,
    refuses: needsTakesToEdit,
    run: async (wb) => (await onDemand(wb.messages, 'Mirroring', () => import('./mirror-takes.ts')))?.runMirror(wb),
  },
  edited(
    'checkTake',
    'Check take…',
    'Check take',
    'Spikes, sliding feet and other problems in what is displayed',
    needsPlayedTake,
  ),
  edited('joinTakes', 'Join…', 'Join takes', 'Cross-fades the selected takes', needsTakesToJoin),
  edited('insertTake', 'Insert take or hold…', 'Insert take or hold', 'At the current time', needsFrames),
  edited('cutOut', 'Cut out…', 'Cut out of take', 'Removes the playback range, or any other', needsFrames),
  edited('loopTake', 'Make loop…', 'Make take loop', 'Blends the whole body', needsTakesToEdit),
  edited('lockFeet', 'Lock feet…', 'Lock feet', 'Holds feet still while they are on the ground', needsTakesToEdit),
  edited('takeSpeed', 'Change speed…', 'Change speed of take', 'Selected takes, or the current one', needsTakesToEdit),
];

/** A tool for whole takes, with a dialog. */
function edited(
  tool: TakeToolName,
  label: string,
  name: string,
  detail: string,
  refuses: NonNullable<Action['refuses']>,
): Action {
  const dialog = (wb: Uses<'dialog'>) => wb.dialog.set(tool);
  return { id: `take.${tool}`, label, name, detail, group: 'Play', menu: EDIT_MENU, section: 5, refuses, run: dialog };
}

/** Loads what matches joints on first use. */
async function compare(wb: Workbench, ...pair: readonly [TakeRow, TakeRow]): Promise<void> {
  const script = await onDemand(wb.messages, 'Comparing', () => import('./start-comparison.ts'));
  script?.compareTakes(wb, ...pair);
}

function put(how: Arrangement, label: string, detail: string): Action {
  return {
    id: `take.put.${how}`,
    label,
    detail,
    group: 'Play',
    menu: MENU,
    section: 8,
    refuses: needsSeveral,
    run: (wb) => putTakes(wb, how),
  };
}

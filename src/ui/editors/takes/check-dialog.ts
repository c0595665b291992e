/** *Check take*: what looks wrong in what the current character plays, a retargeted take too; each leads to its moment. */
import { playedTake } from '../../../evaluate/bake.ts';
import { checkDisplayed } from '../../../review/check-take.ts';
import type { Flag } from '../../../review/flags.ts';
import { runInSlices } from '../../../view/slices.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { openPanel } from '../../state/panels/panels.ts';
import { untilClosed } from '../../state/until-closed.ts';
import type { Uses } from '../../state/workbench.ts';
import type { DialogContent } from '../../widgets/dialog.ts';
import { element, setText } from '../../widgets/dom.ts';
import { plainButton } from '../../widgets/form/form.ts';
import { plural } from '../../widgets/numbers/number-text.ts';
import { flagItem } from '../review/flag-item.ts';
import { flagsText } from '../review/texts.ts';

type Page = Uses<'store' | 'transport' | 'timeline' | 'settings' | 'dialog'>;

export function checkDialog(wb: Page, close: () => void): DialogContent {
  const character = currentCharacter(wb);
  const take = character && playedTake(character);
  const result = element('p', { class: 'tool-result', role: 'status' }, 'Checking …');
  const list = element('ul', { class: 'review-flag-list check-flags', 'aria-label': 'Flags' });
  const measure = plainButton('Measure feet and speeds', () => {
    close();
    openPanel(wb, 'timeline', true);
    wb.timeline.change({ tab: 'measure' });
  });
  const done = element('button', { type: 'button', class: 'plain primary', autofocus: true }, 'Done');
  const body = element(
    'div',
    { class: 'tool-form' },
    element('p', { class: 'faint' }, aboutText(character?.name, take?.name, character?.driver !== undefined)),
    result,
    list,
    element('div', { class: 'tool-buttons' }, measure, done),
  );
  // Times of flags are those of the take.
  const offset = character ? character.timeOffsetSeconds + (character.driver?.source.timeOffsetSeconds ?? 0) : 0;
  const seek = ({ from }: Flag) =>
    wb.transport.update((now) => ({ ...now, playing: false, timeSeconds: from - offset }));
  const show = (flags: readonly Flag[]) => {
    setText(result, flags.length > 0 ? `${plural(flags.length, 'flag')}: ${flagsText(flags)}.` : 'No flags.');
    list.replaceChildren(...flags.map((flag) => flagItem(flag, seek)));
  };
  if (character && take)
    void runInSlices(checkDisplayed(character), untilClosed(wb)).then((flags) => flags && show(flags));
  else setText(result, 'There is no take to check.');
  done.addEventListener('click', close);
  return { title: 'Check take', body, kind: 'tool-dialog is-aside', stays: true };
}

function aboutText(character = 'no character', take = 'no take', isRetargeted: boolean): string {
  return isRetargeted ? `What looks wrong in ${take} as ${character} plays it.` : `What looks wrong in ${take}.`;
}

/** Actions on a retargeted character: as menu entries, as buttons, and as a notice. */
import { type Character, findCharacter } from '../../../model/document.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { attempt } from '../../state/actions/attempt.ts';
import { onDemand } from '../../state/on-demand.ts';
import type { Uses } from '../../state/workbench.ts';
import { element, keepsFocusElsewhere, setText, write } from '../../widgets/dom.ts';
import type { MenuEntry } from '../../widgets/menu.ts';
import { setTooltip } from '../../widgets/tooltip.ts';

export interface MovedChoice {
  readonly label: string;
  readonly tooltip: string;
  run(): void;
}

/** What can be done with a retargeted character. */
function movedChoices(wb: Uses<'store' | 'messages' | 'dialog'>, characterId: string): readonly MovedChoice[] {
  return [
    {
      label: 'Bake',
      tooltip: 'Make it the character’s own take, which can be edited and saved',
      run: () => void change(wb, ({ bakeRetarget }) => wb.store.apply(bakeRetarget, { characterId })),
    },
    {
      label: 'Change…',
      tooltip: 'Which joint follows which, and how',
      run() {
        if (wb.store.selection.characterId !== characterId) wb.store.select({ characterId });
        wb.dialog.set('retarget');
      },
    },
    {
      label: 'Stop',
      tooltip: 'Returns to its own take and pose',
      run: () => void change(wb, ({ clearRetarget }) => wb.store.apply(clearRetarget, { characterId })),
    },
  ];
}

/** Loads the commands on first use. */
async function change(
  wb: Uses<'messages'>,
  run: (commands: typeof import('../../../edit/commands/retarget.ts')) => void,
): Promise<void> {
  const commands = await onDemand(wb.messages, 'Baking', () => import('../../../edit/commands/retarget.ts'));
  if (commands) attempt(wb.messages, () => run(commands));
}

/** The same as menu entries; none unless retargeted. */
export function movedEntries(wb: Uses<'store' | 'messages' | 'dialog'>, { id, driver }: Character): MenuEntry[] {
  if (!driver) return [];
  return [
    ...movedChoices(wb, id).map(({ label, run }): MenuEntry => ({ kind: 'item', label, enabled: true, run })),
    { kind: 'line' },
  ];
}

/** The same as buttons. */
export function movedButtons(
  wb: Uses<'store' | 'messages' | 'dialog'>,
  characterId: () => string | undefined,
): HTMLElement {
  const buttons = ['Bake', 'Change…', 'Stop'].map((label, i) => {
    const made = keepsFocusElsewhere(element('button', { type: 'button', class: 'plain' }, label));
    setTooltip(made, movedChoices(wb, '')[i].tooltip);
    made.addEventListener('click', () => {
      const id = characterId();
      if (id !== undefined) movedChoices(wb, id)[i].run();
    });
    return made;
  });
  return element('span', { class: 'moved-buttons' }, ...buttons);
}

/**
 * The notice above curves and keys while the current character is retargeted and its own keys have no effect. The list
 * of takes shows it in its rows.
 */
export function movedNotice(wb: Uses<'store' | 'timeline' | 'messages' | 'dialog'>): HTMLElement {
  const text = element('span');
  const notice = element('div', { class: 'moved-notice', role: 'note' }, text);
  notice.append(movedButtons(wb, () => currentCharacter(wb)?.id));
  const show = () => {
    const character = currentCharacter(wb);
    const by = character?.driver;
    write(notice, 'hidden', !by || wb.timeline.view.get().tab === 'takes');
    if (!character || !by) return;
    const isGone = findCharacter(wb.store.document, by.sourceId) === undefined;
    const take = by.source.take.name || by.source.name;
    const how = isGone ? 'the source take was removed' : 'retargeted';
    setText(text, `${character.name} is retargeted from ${take} (${how}). Bake to edit it here.`);
    setTooltip(text, text.textContent ?? '');
  };
  wb.store.subscribe((now, before) => {
    if (now.document !== before.document || now.selection.characterId !== before.selection.characterId) show();
  });
  wb.timeline.view.subscribe((now, before) => {
    if (now.tab !== before.tab) show();
  });
  show();
  return notice;
}

/** Below the tree: open files, files that belong to nothing, and problems. */

import { messagesText } from '../../state/messages.ts';
import { openPanel } from '../../state/panels/panels.ts';
import type { Uses } from '../../state/workbench.ts';
import { BLOCKED, copyText } from '../../widgets/clipboard.ts';
import { button, element, setAttribute, setText, uniqueId, write } from '../../widgets/dom.ts';
import { icon } from '../../widgets/icons.ts';
import { diagnosticsList } from './diagnostics-list.ts';
import { filesList } from './files-list.ts';

type TabName = 'files' | 'messages';

export function filesAndMessages(wb: Uses<'store' | 'settings' | 'messages' | 'timeline'>): HTMLElement {
  const files = filesList(wb);
  const messages = diagnosticsList(wb);
  const tools = messageTools(wb);
  const tabs = { files: tab('Files', files.element), messages: tab('Messages', messages) };
  const choose = (name: TabName, focus = false) => {
    for (const [key, { button, panel }] of Object.entries(tabs)) {
      const chosen = key === name;
      setAttribute(button, 'aria-selected', String(chosen));
      write(button, 'tabIndex', chosen ? 0 : -1);
      write(panel, 'hidden', !chosen);
      write(tools, 'hidden', name !== 'messages' || !wb.messages.list.get().length);
      if (chosen && focus) button.focus();
    }
  };
  for (const name of ['files', 'messages'] as const) {
    const other = name === 'files' ? 'messages' : 'files';
    tabs[name].button.addEventListener('click', () => {
      choose(name);
      // The list shows them: mark them as read.
      if (name === 'messages') wb.messages.markAllRead();
    });
    tabs[name].button.addEventListener('keydown', (event) => {
      if (event.key !== 'ArrowLeft' && event.key !== 'ArrowRight') return;
      event.preventDefault();
      choose(other, true);
    });
  }

  let seen = 0;
  const showCounts = () => {
    setText(tabs.files.count, String(files.count || ''));
    const list = wb.messages.list.get();
    setText(tabs.messages.count, String(list.length || ''));
    write(tabs.messages.button.dataset, 'severity', list.some((m) => m.severity === 'error') ? 'error' : '');
    // Scrolls to a new message, as one looks for it here next.
    const newest = list.at(-1);
    if (newest && newest.id > seen) {
      seen = newest.id;
      if (newest.diagnostics.length && newest.severity !== 'info') choose('messages');
    }
    if (!list.length) choose('files');
    write(tools, 'hidden', !list.length || messages.hidden);
  };
  wb.store.subscribe((now, before) => {
    if (now.document !== before.document) showCounts();
  });
  wb.messages.list.subscribe(showCounts);
  wb.messages.listAsked.subscribe(() => {
    openPanel(wb, 'outliner', true);
    choose('messages');
  });
  choose('files');
  showCounts();

  const bar = element(
    'div',
    { role: 'tablist', class: 'tabs', 'aria-label': 'Files and messages' },
    tabs.files.button,
    tabs.messages.button,
  );
  return element(
    'div',
    { class: 'lower' },
    element('div', { class: 'lower-head' }, bar, tools),
    files.element,
    messages,
  );
}

function messageTools(wb: Uses<'messages'>): HTMLElement {
  const copy = async () => {
    const text = messagesText(wb.messages.list.get());
    if (!(await copyText(text))) wb.messages.note(BLOCKED, 'warning');
  };
  return element(
    'div',
    { class: 'tools', hidden: true },
    button('Copy all messages', { class: 'tool small' }, icon('copy'), () => void copy()),
    button('Dismiss all messages', { class: 'tool small' }, icon('close'), () => wb.messages.dismissAll()),
  );
}

function tab(label: string, panel: HTMLElement) {
  const count = element('span', { class: 'count' });
  const id = uniqueId('tab');
  panel.id = uniqueId('tab-panel');
  setAttribute(panel, 'role', 'tabpanel');
  setAttribute(panel, 'aria-labelledby', id);
  const button = element('button', { type: 'button', role: 'tab', id, 'aria-controls': panel.id }, label, count);
  return { button, count, panel };
}

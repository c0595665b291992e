import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { Command } from '../../../src/edit/command.ts';
import type { Document } from '../../../src/model/document.ts';
import { defaultUndoBytes, limitUndo } from '../../../src/ui/shell/undo-memory.ts';
import { character, documentOf, skeleton, workbench } from '../builders.ts';

const replaced: Command<Document> = { id: 'test.replaced', label: () => 'Replace', run: (_, document) => document };

beforeEach(() => {
  vi.useFakeTimers();
});
afterEach(() => {
  vi.useRealTimers();
});

describe('memory for undo', () => {
  it('is a quarter of what the browser gives, and no more than 512 MB', () => {
    expect(defaultUndoBytes({ memory: { jsHeapSizeLimit: 1e9 } })).toBe(250e6);
    expect(defaultUndoBytes({ memory: { jsHeapSizeLimit: 4e9 } })).toBe(512e6);
    expect(defaultUndoBytes({})).toBe(512e6);
  });

  it('the oldest steps are dropped once the setting is exceeded, and a message says how many', () => {
    const { wb } = workbench(documentOf());
    const stop = limitUndo(wb);
    const heavy = () => documentOf(character({ name: 'x'.repeat(1e6), skeleton: skeleton(['hips', -1]) }));
    const open = () => {
      wb.store.apply(replaced, heavy());
      wb.store.apply(replaced, documentOf());
      vi.runAllTimers();
    };
    for (let i = 0; i < 4; i++) open();
    expect(wb.messages.list.get()).toEqual([]);
    wb.settings.update((settings) => ({ ...settings, undoMegabytes: 5 }));
    vi.runAllTimers();
    expect(wb.messages.list.get().map(({ text }) => text)).toEqual([
      'Undo keeps at most 5.0 MB (Edit > Memory for undo): the oldest 4 steps can no longer be undone.',
    ]);
    let undone = 0;
    while (wb.store.undo()) undone++;
    expect(undone).toBe(4);
    stop();
    open();
    expect(wb.messages.list.get()).toHaveLength(1);
  });
});

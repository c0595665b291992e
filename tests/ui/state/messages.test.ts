import { describe, expect, it } from 'vitest';
import type { Diagnostic } from '../../../src/model/diagnostic.ts';
import { caretPad, diagnosticText, Messages, messagesText } from '../../../src/ui/state/messages.ts';

function diagnostic(change: Partial<Diagnostic> = {}): Diagnostic {
  return {
    severity: 'error',
    code: 'number-expected',
    message: 'Expected a number, found "x".',
    file: 'a.skel',
    line: 3,
    column: 11,
    ...change,
  };
}

describe('Messages', () => {
  it('Messages makes one message of a file’s problems, and of the worst file the newest', () => {
    const messages = new Messages();
    messages.report([
      diagnostic({ severity: 'warning', message: 'Odd.' }),
      diagnostic(),
      diagnostic({ file: 'b.skin', severity: 'warning', message: 'Odd too.' }),
    ]);
    expect(messages.list.get()).toMatchObject([
      { severity: 'warning', unread: true, text: 'b.skin:3: Odd too.' },
      { severity: 'error', unread: true, text: 'a.skel:3: 1 error, 1 warning. Expected a number, found "x".' },
    ]);
  });

  it('the problems of a thousand files are one message, which loses those that are right when they are opened again', () => {
    const messages = new Messages();
    const files = Array.from({ length: 1000 }, (_, i) => `${i}.skel`);
    messages.report(
      files.map((file) => diagnostic({ file })),
      [],
      () => 'not opened',
    );
    expect(messages.list.get()).toMatchObject([
      {
        severity: 'error',
        fate: 'not opened',
        text: '1000 files: not opened. The first: 0.skel:3: Expected a number, found "x".',
      },
    ]);
    expect(messages.list.get()[0].diagnostics).toHaveLength(1000);
    messages.report([], files.slice(1));
    expect(messages.list.get().map(({ diagnostics }) => diagnostics.map(({ file }) => file))).toEqual([['0.skel']]);
    messages.report([], files);
    expect(messages.list.get()).toEqual([]);
  });

  it('the message about many files names one that is still wrong when the first has been mended', () => {
    const messages = new Messages();
    const files = Array.from({ length: 30 }, (_, i) => `${i}.skel`);
    messages.report(
      files.map((file) => diagnostic({ file })),
      [],
      () => 'not opened',
    );
    messages.report([], ['0.skel']);
    expect(messages.list.get().map(({ text }) => text)).toEqual([
      '29 files: not opened. The first: 1.skel:3: Expected a number, found "x".',
    ]);
    messages.report([], files.slice(0, 29));
    expect(messages.list.get().map(({ text }) => text)).toEqual([
      '29.skel:3: not opened. Expected a number, found "x".',
    ]);
  });

  it('lists mere notes without a line of their own', () => {
    const messages = new Messages();
    messages.report([diagnostic({ severity: 'info' })]);
    expect(messages.list.get()).toMatchObject([{ unread: false }]);
  });

  it('Messages keeps a message until it is dismissed', () => {
    const messages = new Messages();
    messages.note('Not allowed.', 'warning');
    const [{ id }] = messages.list.get();
    messages.markRead(id);
    expect(messages.list.get()).toMatchObject([{ unread: false }]);
    messages.dismiss(id);
    expect(messages.list.get()).toEqual([]);
  });

  it('Messages says the same notice once', () => {
    const messages = new Messages();
    messages.note('Not allowed.', 'warning');
    messages.note('Not allowed.', 'warning');
    expect(messages.list.get()).toHaveLength(1);
  });

  it('shows of refusals only the last, and none in place of an error', () => {
    const messages = new Messages();
    messages.note('Broken.', 'error');
    messages.note('Not so.', 'warning');
    messages.note('Nor so.', 'warning');
    expect(messages.list.get().map(({ text, unread }) => [text, unread])).toEqual([
      ['Broken.', true],
      ['Not so.', false],
      ['Nor so.', true],
    ]);
  });

  it('lets a confirmation pass without listing it', () => {
    const messages = new Messages();
    messages.note('Saved wasp.skel.');
    expect(messages.passing.get()).toBe('Saved wasp.skel.');
    expect(messages.list.get()).toEqual([]);
    messages.report([diagnostic()]);
    expect(messages.passing.get()).toBeUndefined();
  });

  it('keeps a confirmation that something can be done about until that is over, unless it hides a message', () => {
    const messages = new Messages();
    const undo = { label: 'Undo', run: () => {} };
    messages.confirm('a was removed.', undo, () => false);
    expect(messages.lasts).toBe(true);
    messages.note('Saved wasp.skel.');
    expect(messages.lasts).toBe(false);
    messages.confirm('a was compared.', undo);
    expect(messages.lasts).toBe(false);
    messages.report([diagnostic()]);
    messages.confirm('b was removed.', undo, () => false);
    expect(messages.lasts).toBe(false);
  });

  it('forgets what it said of a file when the file is reported again', () => {
    const messages = new Messages();
    messages.report([diagnostic(), diagnostic({ file: 'b.skin' })]);
    messages.report([diagnostic({ severity: 'warning', message: 'Odd.' })]);
    expect(messages.list.get().map((m) => m.text)).toEqual([
      'b.skin:3: Expected a number, found "x".',
      'a.skel:3: Odd.',
    ]);
    messages.report([], ['b.skin']);
    expect(messages.list.get().map((m) => m.text)).toEqual(['a.skel:3: Odd.']);
  });
});

describe('an opening', () => {
  it('says what happened to a file that has errors or warnings', () => {
    const messages = new Messages();
    const two = [diagnostic({ file: 'b.skin', severity: 'warning', message: 'Odd.' }), diagnostic()];
    messages.report(two, [], (file) => (file === 'a.skel' ? 'not opened' : 'opened'));
    expect(messages.list.get().map((m) => [m.text, m.fate])).toEqual([
      ['b.skin:3: opened. Odd.', 'opened'],
      ['a.skel:3: not opened. Expected a number, found "x".', 'not opened'],
    ]);
    messages.report([diagnostic(), diagnostic()], [], () => 'not opened');
    expect(messages.list.get().at(-1)?.text).toBe('a.skel:3: not opened, 2 errors. Expected a number, found "x".');
  });

  it('leaves only its own messages unread', () => {
    const messages = new Messages();
    messages.report([diagnostic()]);
    messages.report([diagnostic({ file: 'b.skin' })]);
    expect(messages.list.get().map((m) => [m.diagnostics[0].file, m.unread])).toEqual([
      ['a.skel', false],
      ['b.skin', true],
    ]);
    // An info doesn't replace a message that matters.
    messages.report([diagnostic({ file: 'c.bvh', severity: 'info' })]);
    expect(messages.list.get().map((m) => m.unread)).toEqual([false, true, false]);
  });
});

describe('a suggestion', () => {
  it('is listed, and shown unless another is still to be read', () => {
    const messages = new Messages();
    let isOver = false;
    const offer = (label: string) => [{ label, run: () => {} }];
    messages.suggest('a', offer('A'), () => isOver);
    messages.suggest('b', offer('B'), () => false);
    expect(messages.passing.get()).toBe('a');
    expect(messages.offers[0].label).toBe('A');
    expect(messages.list.get().map(({ text }) => text)).toEqual(['a', 'b']);
    isOver = true;
    messages.suggest('c', offer('C'), () => false);
    expect(messages.passing.get()).toBe('c');
    // A note without a button is no suggestion.
    messages.note('Saved.');
    messages.suggest('d', offer('D'), () => false);
    expect(messages.passing.get()).toBe('d');
  });
});

describe('as text', () => {
  it('as text is what a compiler prints', () => {
    const text = diagnosticText(diagnostic({ assumed: 'used 0', excerpt: { text: '\toffset x', caret: 8 } }));
    expect(text).toBe(
      'a.skel:3:11: error number-expected: Expected a number, found "x". (used 0)\n  \toffset x\n  \t       ^',
    );
  });

  it('names no place where there is none', () => {
    expect(diagnosticText(diagnostic({ line: 0, column: 0 }))).toMatch(/^a\.skel: error/);
    const messages = new Messages();
    messages.note('Not allowed.', 'warning');
    expect(messagesText(messages.list.get())).toBe('warning: Not allowed.');
  });

  it('as text keeps tabs in front of the caret', () => {
    expect(caretPad('a\tb', 2)).toBe(' \t');
    expect(caretPad('ab', -1)).toBe('');
  });
});

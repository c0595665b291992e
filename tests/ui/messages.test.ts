import { describe, expect, it } from 'vitest';
import type { Diagnostic } from '../../src/model/diagnostic.ts';
import { caretPad, diagnosticText, Messages, messagesText } from '../../src/ui/messages.ts';

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
  it('makes one message of a file’s problems, the worst of them first', () => {
    const messages = new Messages();
    messages.report([
      diagnostic({ severity: 'warning', message: 'Odd.' }),
      diagnostic(),
      diagnostic({ file: 'b.skin', severity: 'warning', message: 'Odd too.' }),
    ]);
    expect(messages.list.get()).toMatchObject([
      { severity: 'error', unread: true, text: 'a.skel: 1 error, 1 warning. Expected a number, found "x".' },
      { severity: 'warning', unread: true, text: 'b.skin: Odd too.' },
    ]);
  });

  it('lists mere notes without a line of their own', () => {
    const messages = new Messages();
    messages.report([diagnostic({ severity: 'info' })]);
    expect(messages.list.get()).toMatchObject([{ unread: false }]);
  });

  it('keeps a message until it is dismissed', () => {
    const messages = new Messages();
    messages.note('Copied.');
    const [{ id }] = messages.list.get();
    messages.markRead(id);
    expect(messages.list.get()).toMatchObject([{ unread: false }]);
    messages.dismiss(id);
    expect(messages.list.get()).toEqual([]);
  });

  it('says the same notice once', () => {
    const messages = new Messages();
    messages.note('Not allowed.');
    messages.note('Not allowed.');
    expect(messages.list.get()).toHaveLength(1);
  });
});

describe('as text', () => {
  it('is what a compiler prints', () => {
    const text = diagnosticText(diagnostic({ assumed: 'used 0', excerpt: { text: '\toffset x', caret: 8 } }));
    expect(text).toBe(
      'a.skel:3:11: error number-expected: Expected a number, found "x". (used 0)\n  \toffset x\n  \t       ^',
    );
  });

  it('names no place where there is none', () => {
    expect(diagnosticText(diagnostic({ line: 0, column: 0 }))).toMatch(/^a\.skel: error/);
    const messages = new Messages();
    messages.note('Copied.');
    expect(messagesText(messages.list.get())).toBe('info: Copied.');
  });

  it('keeps tabs in front of the caret', () => {
    expect(caretPad('a\tb', 2)).toBe(' \t');
    expect(caretPad('ab', -1)).toBe('');
  });
});

import { describe, expect, it } from 'vitest';
import { reportText } from '../../src/app/fault-report.ts';
import { Faults } from '../../src/app/faults.ts';
import { Messages } from '../../src/ui/state/messages.ts';

function told() {
  const messages = new Messages();
  let saved = 0;
  const faults = new Faults({ messages, files: { saveEverything: () => void saved++, saveText: () => {} } });
  return { messages, faults, texts: () => messages.list.get().map(({ text }) => text), saved: () => saved };
}

describe('errors that nobody caught', () => {
  it('an error that comes back in every frame is told once, also after it was dismissed', () => {
    const { messages, faults, texts } = told();
    const error = new Error('no axis');
    for (let i = 0; i < 100; i++) faults.tell('Something went wrong.', error);
    expect(texts()).toEqual(['Something went wrong. no axis']);
    messages.dismissAll();
    faults.tell('Something went wrong.', error);
    expect(texts()).toEqual([]);
  });

  it('an error stays in the line, and offers to save everything and to copy a report', () => {
    const { messages, faults, saved } = told();
    faults.tell('Something went wrong.', new Error('no axis'));
    const [message] = messages.list.get();
    expect(message).toMatchObject({ severity: 'error', unread: true });
    expect(message.offers?.map(({ label }) => label)).toEqual(['Save everything', 'Copy report']);
    message.offers?.[0].run();
    expect(saved()).toBe(1);
  });

  it('errors that differ each time fill neither the list nor the memory', () => {
    const { faults, texts } = told();
    for (let i = 0; i < 1000; i++) faults.tell('Something went wrong.', `${i}`.repeat(1000));
    expect(texts().length).toBeLessThan(10);
    for (const text of texts()) expect(text.length).toBeLessThan(300);
  });

  it('what is no error is told in its own words', () => {
    const { faults, texts } = told();
    faults.tell('Something went wrong.', undefined);
    faults.tell('Something went wrong.', { toString: () => 'odd' });
    expect(texts()).toEqual(['Something went wrong. undefined', 'Something went wrong. odd']);
  });

  it('a report has the version, the browser, and each error with how often it came', () => {
    const report = reportText(
      new Map([
        ['first', 1],
        ['second', 12],
      ]),
      'Browser/1.0',
    );
    expect(report).toMatch(/^Marrow \d+\.\d+\.\d+, Browser\/1\.0\n\nfirst\n\n12 times: second$/);
  });
});

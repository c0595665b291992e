import { describe, expect, it } from 'vitest';
import { compareDropped } from '../../src/app/comparing.ts';
import type { DumpFile } from '../../src/files/open/open-in-steps.ts';
import { readDump } from '../../src/formats/dump/read.ts';
import type { Character } from '../../src/model/document.ts';
import { Evaluator } from '../../src/teaching/program/evaluator.ts';
import { RIGHT_PROGRAM } from '../../src/teaching/program/program.ts';
import type { Workbench } from '../../src/ui/state/workbench.ts';
import { characterOf, OWN } from '../teaching/lesson-files.ts';
import { documentOf, workbench } from '../ui/builders.ts';
import { InThisThread } from './in-this-thread.ts';

const crawler = characterOf(...OWN.crawler);

function dumpFile(name: string, text: string): DumpFile {
  const { value } = readDump(text, name);
  if (!value) throw new Error(`${name} can't be read.`);
  return { kind: 'dump', dump: value, source: { name, path: `mine/${name}`, bytes: text.length } };
}

/** World matrices as our own. */
function right(time: number): string {
  const wanted = { local: false, vertices: false, normals: false };
  const { world } = new Evaluator(crawler).frame(RIGHT_PROGRAM, time, wanted);
  return `time ${time}\n${Array.from({ length: world.length / 16 }, (_, j) => world.slice(16 * j, 16 * j + 16).join(' ')).join('\n')}`;
}

function drop(wb: Workbench, ...files: DumpFile[]): Promise<void> {
  compareDropped(wb, new InThisThread(), files);
  return new Promise((resolve) => {
    const comparing = wb.comparing.get();
    const look = () => {
      if (comparing && comparing.state.get().phase.kind === 'working') return;
      stop?.();
      resolve();
    };
    const stop = comparing?.state.subscribe(look);
    look();
  });
}

const open = (...characters: Character[]) => workbench(documentOf(...characters)).wb;

describe('dropped dumps', () => {
  it('dropped dumps are compared with the selected character, in the tab that tells of it', async () => {
    const wb = open({ ...crawler, id: 'c1' }, { ...crawler, id: 'c2' });
    wb.store.select({ characterId: 'c2' });
    await drop(wb, dumpFile('mine.txt', right(0.5)));
    expect(wb.comparing.get()?.characterId).toBe('c2');
    expect(wb.comparing.get()?.shown.get()?.frame.agrees).toBe(true);
    expect(wb.timeline.view.get().tab).toBe('compare');
    expect(wb.store.undoLabel).toBeUndefined();
  });

  it('dropped dumps join those of the same character, and replace those of another', async () => {
    const wb = open({ ...crawler, id: 'c1' }, { ...crawler, id: 'c2' });
    wb.store.select({ characterId: 'c1' });
    await drop(wb, dumpFile('a.txt', right(0.5)));
    const first = wb.comparing.get();
    await drop(wb, dumpFile('b.txt', right(0.7)));
    expect(wb.comparing.get()).toBe(first);
    expect(first?.state.get().dumps.map(({ fileName }) => fileName)).toEqual(['a.txt', 'b.txt']);
    wb.store.select({ characterId: 'c2' });
    await drop(wb, dumpFile('c.txt', right(0.5)));
    expect(wb.comparing.get()).not.toBe(first);
    expect(first?.shown.get()).toBeUndefined();
  });

  it('a second drop says what becomes of the numbers before, and the banner which are compared', async () => {
    const wb = open(crawler);
    await drop(wb, dumpFile('a.txt', right(0.5)));
    const said = (text: string) => expect.poll(() => wb.messages.passing.get()).toBe(text);
    const state = () => wb.comparing.get()?.state.get();
    const names = () => state()?.dumps.map(({ fileName }) => fileName);
    await drop(wb, dumpFile('b.txt', right(0.5)));
    await said('b.txt replaced a.txt, which had numbers of the same times.');
    expect([names(), state()?.replaced]).toEqual([['b.txt'], ['a.txt']]);
    await drop(wb, dumpFile('c.txt', right(0.7)));
    await said('Compared along with b.txt.');
    expect([names(), state()?.replaced]).toEqual([['b.txt', 'c.txt'], undefined]);
    await drop(wb, dumpFile('c.txt', right(0.7)));
    await said('c.txt replaced the earlier numbers of that name. Compared along with b.txt.');
  });

  it('dropped dumps that do not fit the selected character are compared with one that they fit', async () => {
    const post = { ...characterOf(...OWN.tangents), id: 'c2', name: 'post' };
    const wb = open(crawler, post);
    wb.store.select({ characterId: 'c2' });
    await drop(wb, dumpFile('mine.txt', right(0.5)));
    await expect.poll(() => wb.comparing.get()?.characterId).toBe(crawler.id);
    expect(wb.comparing.get()?.shown.get()?.frame).toMatchObject({ time: 0.5, agrees: true });
    expect(wb.store.selection).toEqual({ characterId: crawler.id });
    expect(wb.messages.list.get()).toEqual([]);
    expect(wb.messages.passing.get()).toBe('Compared with crawler, which the numbers fit.');
  });

  it('a dump that does not fit is a message with its line, which a fitting one takes away', async () => {
    const wb = open(crawler);
    await drop(wb, dumpFile('mine.txt', '\n1 2 3\n'));
    expect(wb.messages.list.get()).toMatchObject([
      { severity: 'error', fate: 'not compared', unread: false, diagnostics: [{ file: 'mine.txt', line: 2 }] },
    ]);
    await drop(wb, dumpFile('mine.txt', right(0)));
    expect(wb.messages.list.get()).toEqual([]);
  });

  it('dumps of one drop that fit are compared, and the others are messages', async () => {
    const wb = open(crawler);
    await drop(wb, dumpFile('a.txt', right(0.5)), dumpFile('short.txt', '1 2 3\n'), dumpFile('twice.txt', right(0.5)));
    const state = wb.comparing.get()?.state.get();
    expect(state?.dumps.map(({ fileName }) => fileName)).toEqual(['a.txt']);
    expect(state?.result?.comparison.agrees).toBe(true);
    expect(wb.messages.list.get().map(({ text }) => text)).toEqual([
      expect.stringMatching(/^short\.txt:1: not compared\. Expected/),
      expect.stringMatching(/^twice\.txt:2: not compared\. Expected one list of world at 0\.5 s/),
    ]);
  });

  it('further dumps that do not fit are messages, which no word about the others hides', async () => {
    const wb = open(crawler);
    const said: (string | undefined)[] = [];
    wb.messages.passing.subscribe((text) => text && said.push(text));
    const hasSaid = (...texts: readonly string[]) => expect.poll(() => said).toEqual(texts);
    await drop(wb, dumpFile('a.txt', right(0.5)));
    await drop(wb, dumpFile('b.txt', right(0.7)));
    const along = 'Compared along with a.txt.';
    await hasSaid(along);
    await drop(wb, dumpFile('short.txt', '1 2 3\n'));
    await expect.poll(() => wb.messages.list.get()).toMatchObject([{ fate: 'not compared', unread: true }]);
    // What was to be said of them would have been by now.
    await new Promise(setImmediate);
    await drop(wb, dumpFile('a.txt', right(0.5)));
    await hasSaid(along, 'a.txt replaced the earlier numbers of that name. Compared along with b.txt.');
  });

  it('dumps without a character say what is missing', async () => {
    const wb = open();
    await drop(wb, dumpFile('mine.txt', '1 2 3'));
    expect(wb.comparing.get()).toBeUndefined();
    expect(wb.messages.list.get()).toMatchObject([{ text: 'Open a character first, to compare mine.txt with it.' }]);
  });
});

import { describe, expect, it } from 'vitest';
import { removeCharacter, setTimeOffset, showTake } from '../../../src/edit/commands/characters.ts';
import { setDofs } from '../../../src/edit/commands/pose.ts';
import { DEFAULT_PLAYBACK } from '../../../src/edit/playback.ts';
import { Store } from '../../../src/edit/store.ts';
import { readDump } from '../../../src/formats/dump/read.ts';
import type { Character } from '../../../src/model/document.ts';
import type { NamedDump } from '../../../src/teaching/dump/fit-dump.ts';
import { Evaluator } from '../../../src/teaching/program/evaluator.ts';
import { type JointRules, RIGHT_PROGRAM } from '../../../src/teaching/program/program.ts';
import { type CompareInput, type CompareOutput, DumpComparison } from '../../../src/ui/state/dump-comparison.ts';
import { onShown } from '../../../src/ui/state/shown-comparison.ts';
import { observable } from '../../../src/ui/widgets/observable.ts';
import { compareDumps } from '../../../src/worker/compare-program.ts';
import { describeShared, sharedBytes } from '../../helpers/shared.ts';
import { characterOf, OWN } from '../../teaching/lesson-files.ts';
import { documentOf } from '../builders.ts';

const crawler = characterOf(...OWN.crawler);

/** World matrices at times as a program prints them, with a mistake. */
function dump(fileName: string, times: readonly (number | undefined)[], rules: Partial<JointRules> = {}): NamedDump {
  const evaluator = new Evaluator(crawler);
  const program = { ...RIGHT_PROGRAM, joints: { ...RIGHT_PROGRAM.joints, ...rules } };
  const lines = times.flatMap((time) => {
    const { world } = evaluator.frame(program, time, { local: false, vertices: false, normals: false });
    const rows = Array.from({ length: world.length / 16 }, (_, j) => world.slice(16 * j, 16 * j + 16).join(' '));
    return time === undefined ? rows : [`time ${time}`, ...rows];
  });
  return named(fileName, lines.join('\n'));
}

function named(fileName: string, text: string | Uint8Array): NamedDump {
  const { value } = readDump(text, fileName);
  if (!value) throw new Error(`${fileName} can't be read.`);
  return { fileName, dump: value };
}

/** Assumed for dumps that state none. */
const timesOf = ({ dumps }: CompareInput) => dumps.map(({ assumed }) => assumed?.time);

function withoutTime({ fileName, dump: { blocks, ...rest } }: NamedDump): NamedDump {
  return { fileName, dump: { ...rest, blocks: blocks.map(({ time: _, ...block }) => block) } };
}

const NO_PARENT = { concatenation: 'no parent' } as const;

/** A page with one comparison, whose jobs run in this thread, and wait for `quiet` after edits. */
function comparisonOf(character: Character, dumps: readonly NamedDump[], timeSeconds = 0) {
  const store = new Store(documentOf(character));
  const transport = observable({ ...DEFAULT_PLAYBACK, timeSeconds });
  const inputs: CompareInput[] = [];
  const waiting = new Set<() => void>();
  const run = async (input: CompareInput, signal: AbortSignal): Promise<CompareOutput> => {
    inputs.push(input);
    await Promise.resolve();
    signal.throwIfAborted();
    return compareDumps(structuredClone(input), () => undefined);
  };
  const comparing = new DumpComparison({ store, transport }, character.id, dumps, run, {
    later: (work) => {
      waiting.add(work);
      return () => void waiting.delete(work);
    },
  });
  const settled = () =>
    new Promise<void>((resolve) => {
      const look = () => {
        if (comparing.state.get().phase.kind === 'working') return;
        stop();
        resolve();
      };
      const stop = comparing.state.subscribe(look);
      look();
    });
  /** The pause after edits is over. */
  const quiet = () => {
    const due = [...waiting];
    waiting.clear();
    for (const work of due) work();
  };
  const at = (seconds: number) => transport.update((now) => ({ ...now, timeSeconds: seconds }));
  return { store, transport, inputs, waiting, comparing, settled, quiet, at };
}

describe('a comparison with dumps', () => {
  it('has theirs beside ours, and is no step of the document', async () => {
    const { comparing, settled, store } = comparisonOf(crawler, [dump('mine.txt', [0.3], NO_PARENT)], 0.3);
    await settled();
    const shown = comparing.shown.get();
    expect(shown?.frame).toMatchObject({ time: 0.3, agrees: false });
    expect(shown?.theirs.world?.length).toBe(16 * (crawler.skeleton?.joints.length ?? 0));
    expect(shown?.frame.ours.world.length).toBe(shown?.theirs.world?.length);
    expect(comparing.state.get().result?.comparison.causes[0]?.code).toBe('no-parent');
    expect(store.undoLabel).toBeUndefined();
  });

  it('says which dumps were given last', async () => {
    const { comparing, settled } = comparisonOf(crawler, [dump('mine.txt', [0.3])], 0.3);
    expect(comparing.state.get().newest).toEqual(['mine.txt']);
    await settled();
    await comparing.add([dump('more.txt', [0.6])]);
    const { newest, dumps } = comparing.state.get();
    expect([newest, dumps.map(({ fileName }) => fileName)]).toEqual([['more.txt'], ['mine.txt', 'more.txt']]);
  });

  it('shows the frame nearest to the time shown, within half a frame, while time moves', async () => {
    const { comparing, settled, at } = comparisonOf(crawler, [dump('all.txt', [0, 0.5, 1], NO_PARENT)], 0.25);
    await settled();
    at(0.25);
    expect(comparing.shown.get()).toBeUndefined();
    const seen: (number | undefined)[] = [];
    comparing.shown.subscribe((now) => seen.push(now?.frame.time));
    for (const seconds of [0.49, 0.5, 0.516, 0.518, 0.99, 1]) at(seconds);
    // Half of 1/30 s; each frame is told once.
    expect(seen).toEqual([0.5, undefined, 1]);
    comparing.goTo(0);
    expect(comparing.shown.get()?.frame.time).toBe(0);
  });

  it('is of the time shown if the dump states none, and of the file pose without a take', async () => {
    const moving = comparisonOf(crawler, [dump('mine.txt', [undefined])], 0.4);
    await moving.settled();
    expect(timesOf(moving.inputs[0])).toEqual([0.4]);
    moving.at(0.9);
    expect(moving.comparing.shown.get()).toBeUndefined();
    const resting = comparisonOf({ ...crawler, shownTake: -1 }, [dump('mine.txt', [undefined])], 0.4);
    await resting.settled();
    expect(timesOf(resting.inputs[0])).toEqual([undefined]);
    resting.at(0.9);
    expect(resting.comparing.shown.get()?.frame).toMatchObject({ agrees: true });
  });

  it('shows time 0 without a take as the file pose, at once and at any time; numbers without a time replace it', async () => {
    const still = { ...crawler, shownTake: -1 };
    const { comparing, settled, at } = comparisonOf(still, [dump('mine.txt', [0], NO_PARENT)], 0.9);
    await settled();
    expect(comparing.shown.get()?.frame).toMatchObject({ time: 0, agrees: false });
    at(2);
    expect(comparing.shown.get()?.index).toBe(0);
    await comparing.add([dump('pasted.txt', [undefined])]);
    expect(comparing.state.get()).toMatchObject({ replaced: ['mine.txt'], dumps: [{ fileName: 'pasted.txt' }] });
    expect(comparing.shown.get()?.frame.agrees).toBe(true);
    await comparing.add([dump('again.txt', [0])]);
    expect(comparing.state.get().replaced).toEqual(['pasted.txt']);
  });

  it('shows the nearest of several times without a take, which are of the same pose', async () => {
    const { comparing, settled, at } = comparisonOf({ ...crawler, shownTake: -1 }, [dump('mine.txt', [0, 1.5])]);
    await settled();
    expect(comparing.shown.get()?.index).toBe(0);
    comparing.goTo(1);
    expect(comparing.shown.get()?.frame.time).toBe(1.5);
    at(1.4);
    expect(comparing.shown.get()?.index).toBe(1);
    comparing.goTo(0);
    expect(comparing.shown.get()?.index).toBe(0);
  });

  it('goes by the time of the take, wherever it starts on the timeline', async () => {
    const { comparing, settled, store, transport } = comparisonOf(crawler, [dump('mine.txt', [0.5])], 0.5);
    await settled();
    store.apply(setTimeOffset, { characterId: crawler.id, seconds: 0.2 });
    expect(comparing.shown.get()).toBeUndefined();
    expect(comparing.state.get().phase.kind).toBe('done');
    comparing.goTo(0);
    expect(transport.get().timeSeconds).toBeCloseTo(0.3, 12);
    expect(comparing.shown.get()?.frame.agrees).toBe(true);
  });

  it('dumps of the same name are replaced, others join, and those of the same times replace what was there', async () => {
    const { comparing, settled } = comparisonOf(crawler, [dump('a.txt', [0.3], NO_PARENT)], 0.3);
    await settled();
    const names = () => comparing.state.get().dumps.map(({ fileName }) => fileName);
    await comparing.add([dump('a.txt', [0.3])]);
    expect(comparing.state.get().result?.comparison.agrees).toBe(true);
    await comparing.add([dump('b.txt', [0.6], NO_PARENT)]);
    expect(names()).toEqual(['a.txt', 'b.txt']);
    expect(comparing.state.get().result?.comparison.frames.map(({ agrees }) => agrees)).toEqual([true, false]);
    await comparing.add([dump('c.txt', [0.6])]);
    expect(names()).toEqual(['c.txt']);
    expect(comparing.state.get().result?.comparison.agrees).toBe(true);
  });

  it('goes to the first time that differs, unless a compared time is shown or unkeyed changes would be lost', async () => {
    const dumps = [dump('a.txt', [0.2]), dump('b.txt', [0.7, 0.9], NO_PARENT)];
    const fresh = comparisonOf(crawler, dumps, 0.4);
    fresh.transport.update((now) => ({ ...now, playing: true }));
    await fresh.settled();
    expect(fresh.transport.get()).toMatchObject({ timeSeconds: 0.7, playing: false });
    const there = comparisonOf(crawler, dumps, 0.9);
    await there.settled();
    expect(there.transport.get().timeSeconds).toBe(0.9);
    const changed = comparisonOf({ ...crawler, unkeyed: { timeSeconds: 0.4, dofs: [4], values: [1] } }, dumps, 0.4);
    await changed.settled();
    expect(changed.transport.get().timeSeconds).toBe(0.4);
    fresh.at(0.1);
    fresh.comparing.again();
    await fresh.settled();
    expect(fresh.transport.get().timeSeconds).toBe(0.1);
  });

  it.each([
    ['mistakes', NO_PARENT, ['no-parent']],
    // Also the numbers of a program that ignores the take.
    ['nothing', {}, []],
  ] as const)(
    'takes numbers without a time for those of the file pose where %s explains them',
    async (_, rules, codes) => {
      const { comparing, settled, inputs } = comparisonOf(crawler, [dump('rest.txt', [undefined], rules)], 0.4);
      await settled();
      expect(inputs.map(timesOf)).toEqual([[0.4]]);
      const { dumps, result } = comparing.state.get();
      expect(dumps).toMatchObject([{ assumed: { time: undefined } }]);
      expect(result?.comparison.causes.map(({ code }) => code)).toEqual(codes);
      expect(result?.comparison.agrees).toBe(codes.length === 0);
      // It stays so, until another time is given.
      comparing.setTime('rest.txt', 0.4);
      await settled();
      expect(comparing.state.get().result?.comparison.agrees).toBe(false);
      expect(inputs.at(-1)?.undecided).toEqual([]);
    },
  );

  it('each dump keeps the time that was shown when it was dropped, until it is given another', async () => {
    const { comparing, settled, at, inputs } = comparisonOf(crawler, [dump('a.txt', [undefined])], 0.3);
    // Of the times that they are dropped at.
    const [a, b] = [0.3, 0.8].map((time) => withoutTime(dump('x.txt', [time])));
    await settled();
    await comparing.add([{ ...a, fileName: 'a.txt' }]);
    at(0.8);
    await comparing.add([{ ...b, fileName: 'b.txt' }]);
    expect(comparing.state.get().result?.comparison.frames.map(({ time }) => time)).toEqual([0.3, 0.8]);
    expect(comparing.state.get().result?.comparison.agrees).toBe(true);
    comparing.setTime('b.txt', 0.1);
    await settled();
    expect(timesOf(inputs[inputs.length - 1])).toEqual([0.3, 0.1]);
    expect(comparing.state.get().result?.comparison.frames.map(({ agrees }) => agrees)).toEqual([true, false]);
  });

  it('a dump without a time is of the one that the others of its drop state', async () => {
    const dumps = [dump('a.txt', [0.7]), withoutTime({ ...dump('b.txt', [0.7]), fileName: 'local.txt' })];
    const { settled, inputs } = comparisonOf(crawler, dumps, 0.2);
    await settled();
    expect(timesOf(inputs[0])).toEqual([undefined, 0.7]);
  });

  it('one of several dumps can be removed', async () => {
    const { comparing, settled } = comparisonOf(crawler, [dump('a.txt', [0.2]), dump('b.txt', [0.7], NO_PARENT)], 0.2);
    await settled();
    comparing.remove('b.txt');
    await settled();
    expect(comparing.state.get().result?.comparison).toMatchObject({ agrees: true, compared: { world: 26 } });
  });

  it('says which line of a dump does not fit', async () => {
    const { comparing, settled } = comparisonOf(crawler, [named('short.txt', '# mine\n1 2 3\n4 5 6\n')]);
    await settled();
    expect(comparing.state.get().phase).toMatchObject({
      kind: 'misfit',
      diagnostics: [{ code: 'dump-length', file: 'short.txt', line: 2 }],
    });
    expect(comparing.state.get().result).toBeUndefined();
  });

  it('an edit compares again after the last of several, and keeps the result meanwhile', async () => {
    const { comparing, settled, store, inputs, waiting, quiet } = comparisonOf({ ...crawler, shownTake: -1 }, [
      dump('mine.txt', [undefined]),
    ]);
    await settled();
    const before = comparing.shown.get();
    for (const value of [0.1, 0.2, 0.3]) {
      store.apply(setDofs, { characterId: crawler.id, dofs: [{ index: 4, value }], timeSeconds: 0 });
    }
    expect(waiting.size).toBe(1);
    expect(comparing.shown.get()).toBe(before);
    quiet();
    await settled();
    expect(inputs).toHaveLength(2);
    expect(comparing.shown.get()?.frame).toMatchObject({ agrees: false, own: [0] });
    store.undo();
    store.undo();
    store.undo();
    quiet();
    await settled();
    expect(comparing.shown.get()?.frame.agrees).toBe(true);
  });

  it('the latest change wins over a comparison that is running', async () => {
    const { comparing, settled, inputs } = comparisonOf(crawler, [dump('mine.txt', [0.3])], 0.3);
    comparing.setTolerance(1e-3);
    comparing.setTolerance(1e-9);
    await settled();
    expect(inputs).toHaveLength(3);
    expect(comparing.state.get().result?.tolerance).toBe(1e-9);
  });

  it('can be cancelled, and started again', async () => {
    const { comparing, settled } = comparisonOf(crawler, [dump('mine.txt', [0.3])], 0.3);
    comparing.cancel();
    expect(comparing.state.get().phase).toEqual({ kind: 'cancelled' });
    comparing.again();
    await settled();
    expect(comparing.state.get().phase).toEqual({ kind: 'done' });
  });

  it('a failing worker is said, and the next try may succeed', async () => {
    const transport = observable(DEFAULT_PLAYBACK);
    const store = new Store(documentOf(crawler));
    let fails = true;
    const comparing = new DumpComparison({ store, transport }, crawler.id, [dump('mine.txt', [0])], async (input) => {
      if (fails) throw new Error('The worker stopped.');
      return compareDumps(input, () => undefined);
    });
    await Promise.resolve();
    expect(comparing.state.get().phase).toEqual({ kind: 'failed', message: 'The worker stopped.' });
    fails = false;
    await comparing.add([dump('mine.txt', [0])]);
    expect(comparing.shown.get()?.frame.agrees).toBe(true);
  });

  it('shows nothing while its character is removed, and again after undo', async () => {
    const { comparing, settled, store, quiet } = comparisonOf(crawler, [dump('mine.txt', [0])]);
    await settled();
    store.apply(removeCharacter, { characterId: crawler.id });
    expect(comparing.shown.get()).toBeUndefined();
    store.undo();
    quiet();
    await settled();
    expect(comparing.shown.get()?.frame.agrees).toBe(true);
  });

  it('drops a result whose arrays no longer fit', async () => {
    const { comparing, settled, store } = comparisonOf(crawler, [dump('mine.txt', [0])]);
    await settled();
    store.apply(showTake, { characterId: crawler.id, take: -1 });
    expect(comparing.state.get().result).toBeUndefined();
    expect(comparing.shown.get()).toBeUndefined();
  });

  it('tells its followers of what is shown, and of its end', async () => {
    const { comparing, settled } = comparisonOf(crawler, [dump('mine.txt', [0])]);
    const page = { comparing: observable<DumpComparison | undefined>(undefined) };
    const seen: (boolean | undefined)[] = [];
    const stop = onShown(page, (shown) => seen.push(shown?.frame.agrees));
    page.comparing.set(comparing);
    await settled();
    comparing.end();
    page.comparing.set(undefined);
    stop();
    page.comparing.set(comparing);
    expect(seen).toEqual([undefined, undefined, true, undefined, undefined]);
  });
});

describeShared('the dumps of the reference, on the page', () => {
  it('are compared with a character of the page', async () => {
    const wasp = characterOf('data/cse169/wasp.skel', 'data/cse169/wasp_walk.anim');
    const bytes = sharedBytes('conformance/compare/d000.txt');
    const { comparing, settled } = comparisonOf(wasp, [named('d000.txt', bytes)], 1.5);
    await settled();
    expect(comparing.shown.get()?.frame).toMatchObject({ time: 1.5, agrees: true });
  });
});

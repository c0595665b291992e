/** Compares dumps that were opened with the character that they are of; loaded with the first of them. */

import type { DumpFile } from '../files/open/open-in-steps.ts';
import type { NamedDump } from '../teaching/dump/fit-dump.ts';
import { currentCharacter } from '../ui/state/actions/action.ts';
import { type ComparePhase, DumpComparison, type RunCompare } from '../ui/state/dump-comparison.ts';
import type { Uses } from '../ui/state/workbench.ts';
import type { Runs } from '../worker/client.ts';

type Parts = Uses<'store' | 'transport' | 'messages' | 'comparing' | 'timeline'>;

/**
 * Compares them with the current character, along with those that are compared with it already. If they don't fit it,
 * with the first that they fit.
 */
export function compareDropped(wb: Parts, worker: Runs<'compare'>, files: readonly DumpFile[]): void {
  const { comparing, messages, timeline } = wb;
  const dumps = files.map(({ source, dump }) => ({ fileName: source.name, dump }));
  const character = currentCharacter(wb);
  if (!character) {
    messages.note(`Open a character first, to compare ${dumps[0].fileName} with it.`, 'warning');
    return;
  }
  const before = comparing.get();
  if (before?.characterId === character.id) {
    void addTo(before, dumps, messages);
    return;
  }
  before?.end();
  const run: RunCompare = (input, signal, onProgress) =>
    worker.run('compare', input, { signal, onProgress: ({ done, of }) => onProgress(done / of) });
  const made = new DumpComparison(wb, character.id, dumps, run);
  reportProblems(wb, made);
  comparing.set(made);
  timeline.change({ tab: 'compare' });
  void tryOthers(wb, made, dumps, run);
}

/** Compares further numbers, and says what becomes of those before. */
async function addTo(
  comparing: DumpComparison,
  dumps: readonly NamedDump[],
  messages: Parts['messages'],
): Promise<void> {
  const before = comparing.state.get().dumps.map(({ fileName }) => fileName);
  await comparing.add(dumps);
  const { phase, newest, dumps: after, replaced = [] } = comparing.state.get();
  // Those that were not compared are messages, which this would hide.
  if (phase.kind !== 'done' || phase.problems) return;
  const names = newest.join(', ');
  const again = newest.filter((name) => before.includes(name));
  const others = after.map(({ fileName }) => fileName).filter((name) => !newest.includes(name));
  const sentences = [
    ...(replaced.length > 0 ? [`${names} replaced ${replaced.join(', ')}, which had numbers of the same times.`] : []),
    ...(again.length > 0 ? [`${again.join(', ')} replaced the earlier numbers of that name.`] : []),
    ...(others.length > 0 ? [`Compared along with ${others.join(', ')}.`] : []),
  ];
  if (sentences.length > 0) messages.note(sentences.join(' '));
}

/** Another character takes the place of one that the dumps don't fit. */
async function tryOthers(
  wb: Parts,
  first: DumpComparison,
  dumps: readonly NamedDump[],
  run: RunCompare,
): Promise<void> {
  if ((await settled(first)).kind !== 'misfit') return;
  for (const { id, name } of wb.store.document.characters) {
    if (id === first.characterId) continue;
    const other = new DumpComparison(wb, id, dumps, run, { isTrial: true });
    const phase = await settled(other);
    // Ended, or given other dumps, meanwhile.
    const isWanted = wb.comparing.get() === first && first.state.get().phase.kind === 'misfit';
    if (!isWanted || phase.kind !== 'done') {
      other.end();
      if (!isWanted) return;
      continue;
    }
    first.end();
    wb.messages.report(
      [],
      dumps.map(({ fileName }) => fileName),
    );
    reportProblems(wb, other);
    wb.comparing.set(other);
    wb.store.select({ characterId: id });
    other.reveal();
    wb.messages.note(`Compared with ${name}, which the numbers fit.`);
    return;
  }
}

/** Resolves once it isn't working any more. */
function settled(comparing: DumpComparison): Promise<ComparePhase> {
  return new Promise((resolve) => {
    let stop: (() => void) | undefined;
    const look = () => {
      const { phase } = comparing.state.get();
      if (phase.kind === 'working') return;
      stop?.();
      resolve(phase);
    };
    stop = comparing.state.subscribe(look);
    look();
  });
}

/** Problems of the dumps are messages, with their lines. */
function reportProblems({ messages }: Uses<'messages'>, comparing: DumpComparison): void {
  comparing.state.subscribe(({ phase, dumps }, before) => {
    if (phase === before.phase || (phase.kind !== 'done' && phase.kind !== 'misfit')) return;
    const problems = phase.kind === 'misfit' ? phase.diagnostics : (phase.problems ?? []);
    const names = dumps.map(({ fileName }) => fileName);
    messages.report(problems, names, () => 'not compared');
    // The banner says the same.
    if (phase.kind === 'misfit') messages.markAllRead();
  });
}

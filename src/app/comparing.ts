/** Compares dumps that were opened with the character that they are of; loaded with the first of them. */
import type { DumpFile } from '../project/open/open-files.ts';
import { currentCharacter } from '../ui/state/action.ts';
import { DumpComparison, type RunCompare } from '../ui/state/dump-comparison.ts';
import type { Uses } from '../ui/state/workbench.ts';
import type { Runs } from '../worker/client.ts';

type Parts = Uses<'store' | 'transport' | 'messages' | 'comparing' | 'timeline'>;

/** Compares them with the current character, along with those that are compared with it already. */
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
    void before.add(dumps);
    return;
  }
  before?.end();
  const run: RunCompare = (input, signal, onProgress) =>
    worker.run('compare', input, { signal, onProgress: ({ done, of }) => onProgress(done / of) });
  const made = new DumpComparison(wb, character.id, dumps, run);
  reportProblems(wb, made);
  comparing.set(made);
  timeline.change({ tab: 'compare' });
}

/** Problems of the dumps are messages, with their lines. */
function reportProblems({ messages }: Uses<'messages'>, comparing: DumpComparison): void {
  comparing.state.subscribe(({ phase, dumps }, before) => {
    if (phase === before.phase || (phase.kind !== 'done' && phase.kind !== 'misfit')) return;
    const names = dumps.map(({ fileName }) => fileName);
    messages.report(phase.kind === 'misfit' ? phase.diagnostics : [], names, () => 'not compared');
  });
}

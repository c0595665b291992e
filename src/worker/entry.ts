/** The worker's side: receives a job, runs it, responds. */

import { provideLayers } from '../evaluate/layers.ts';
import { sentenceOf } from '../model/failure.ts';
import { testKit } from '../teaching/kit/kit.ts';
import { compareDumps } from './compare-program.ts';
import { parse } from './parse.ts';
import { partsOf } from './parts.ts';
import { passageOf } from './passage.ts';
import type { FromWorker, Progress, ToWorker } from './protocol.ts';
import { mapSourceOf } from './source.ts';

/** The part of a dedicated worker's global scope that is used; the project's types are those of a page. */
interface WorkerScope {
  onmessage: ((event: MessageEvent<ToWorker>) => void) | null;
  postMessage(message: FromWorker, transfer?: Transferable[]): void;
}
// To the compiler `self` is a window; in a worker it is this.
const scope = self as unknown as WorkerScope;

// Characters and takes that are passed on may have layers.
provideLayers();
scope.onmessage = async ({ data }) => {
  const { id } = data;
  try {
    const onProgress = (progress: Progress) => scope.postMessage({ id, kind: 'progress', progress });
    if (data.job === 'parse') {
      const output = await parse(data.input, onProgress);
      for (const { part, transfer } of partsOf(output)) scope.postMessage({ id, kind: 'part', part }, transfer);
      done({ id, kind: 'done', job: data.job, output: { ...output, files: [], facts: [] } });
    } else if (data.job === 'source')
      done({ id, kind: 'done', job: data.job, output: await mapSourceOf(data.input, onProgress) });
    else if (data.job === 'changes') {
      const { changesOf } = await changes();
      done({ id, kind: 'done', job: data.job, output: await changesOf(data.input) });
    } else if (data.job === 'check') {
      const { checkText } = await changes();
      done({ id, kind: 'done', job: data.job, output: await checkText(data.input, onProgress) });
    } else if (data.job === 'review') {
      const { reviewTakes } = await import('./review.ts');
      done({ id, kind: 'done', job: data.job, output: await reviewTakes(data.input) });
    } else if (data.job === 'unpack') {
      const { unpackTakes } = await import('./review.ts');
      done({ id, kind: 'done', job: data.job, output: await unpackTakes(data.input) });
    } else if (data.job === 'exchange') {
      const { exchangeFileOf } = await import('./exchange.ts');
      done({ id, kind: 'done', job: data.job, output: await exchangeFileOf(data.input, onProgress) });
    } else if (data.job === 'kit') done({ id, kind: 'done', job: data.job, output: testKit() });
    else done({ id, kind: 'done', job: data.job, output: compareDumps(data.input, onProgress) });
  } catch (error) {
    scope.postMessage({ id, kind: 'failed', message: sentenceOf(error) });
  }
};

// A worker that the browser ends says nothing; but the browser releases its locks. Plain http has none.
const locks = navigator.locks as LockManager | undefined;
const lock = `marrow-worker-${crypto.getRandomValues(new Uint32Array(4)).join('-')}`;
void locks?.request(lock, () => {
  scope.postMessage({ kind: 'alive', lock });
  return new Promise<never>(() => undefined);
});

/** With all that writes files, which reading needs nothing of. */
const changes = () => import('./changes.ts');

function done(message: Extract<FromWorker, { readonly kind: 'done' }>): void {
  scope.postMessage(message, passageOf(message.output).transfer);
}

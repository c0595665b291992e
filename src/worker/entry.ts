/** The worker's side: takes a job, runs it, answers. */
import { parse } from './parse.ts';
import type { FromWorker, Progress, ToWorker } from './protocol.ts';
import { transferables } from './transferables.ts';

/** What of a dedicated worker's global scope is used; the project's types are those of a page. */
interface WorkerScope {
  onmessage: ((event: MessageEvent<ToWorker>) => void) | null;
  postMessage(message: FromWorker, transfer?: Transferable[]): void;
}
// `self` is a window to the compiler; in a worker it is this.
const scope = self as unknown as WorkerScope;

scope.onmessage = async ({ data }) => {
  const { id } = data;
  try {
    const output = await parse(data.input, (progress: Progress) =>
      scope.postMessage({ id, kind: 'progress', progress }),
    );
    const message: FromWorker = { id, kind: 'done', job: data.job, output };
    scope.postMessage(message, transferables(output));
  } catch (error) {
    scope.postMessage({ id, kind: 'failed', message: error instanceof Error ? error.message : String(error) });
  }
};

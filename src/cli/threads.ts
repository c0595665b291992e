/**
 * Shares work among threads that run this very program. Each asks for the next piece when it is done with one, so a
 * slow one holds up nobody; a thread that dies takes only its own piece with it.
 */
import { availableParallelism } from 'node:os';
import { setImmediate as nextTurn } from 'node:timers/promises';
import { isMainThread, type MessagePort, parentPort, Worker, workerData } from 'node:worker_threads';

/** Does one kind of work: made once per thread from what all pieces share. Everything passed must be cloneable. */
export type Work<Shared, Piece, Result> = (shared: Shared) => (piece: Piece) => Result | Promise<Result>;

export interface SharedWork<Shared, Piece, Result> {
  /** The name of the work in `worksInThread`. */
  readonly name: string;
  readonly work: Work<Shared, Piece, Result>;
  readonly shared: Shared;
  readonly pieces: readonly Piece[];
  /** How many threads; absent: as many as cores. */
  readonly threads?: number;
  /** Fewer pieces than this are done here, since starting a thread takes as long. */
  readonly few: number;
  /** After each piece, in the order in which they are done. */
  done(piece: Piece, result: Result, index: number): void;
  /** The result of a piece whose thread died, with the reason. */
  lost(piece: Piece, reason: string): Result;
}

/** What a thread begins with. */
interface Task {
  readonly isSharedWork: true;
  readonly name: string;
  readonly shared: unknown;
}

/** From a thread: absent before its first piece. */
interface Answer {
  readonly result?: unknown;
}

/**
 * @param program what a thread runs, which calls `worksInThread`; absent: all is done here
 * @throws what `done` throws; no more pieces are begun then
 */
export async function shareWork<Shared, Piece, Result>(
  { name, work, shared, pieces, threads = availableParallelism(), few, done, lost }: SharedWork<Shared, Piece, Result>,
  program: URL | undefined,
): Promise<void> {
  if (!program || pieces.length < few || threads < 2) {
    const own = work(shared);
    for (const [i, piece] of pieces.entries()) {
      done(piece, await own(piece), i);
      // Without a turn of the loop in between, files that were read are never let go of, nor are signals heard.
      await nextTurn();
    }
    return;
  }
  let next = 0;
  const task: Task = { isSharedWork: true, name, shared };
  const start = (): Promise<void> =>
    new Promise((resolve, reject) => {
      const worker = new Worker(program, { workerData: task });
      let current: number | undefined;
      let reason = 'the thread ended';
      worker.on('message', (answer: Answer) => {
        try {
          // The other end is this very work, made with the same types.
          if (current !== undefined) done(pieces[current], answer.result as Result, current);
        } catch (error) {
          next = pieces.length;
          current = undefined;
          void worker.terminate();
          reject(error);
          return;
        }
        current = next < pieces.length ? next++ : undefined;
        worker.postMessage(current === undefined ? { isOver: true } : { piece: pieces[current] });
      });
      worker.on('error', (error) => {
        reason = error.message;
      });
      worker.on('exit', () => {
        if (current === undefined) {
          resolve();
          return;
        }
        done(pieces[current], lost(pieces[current], reason), current);
        resolve(next < pieces.length ? start() : undefined);
      });
    });
  await Promise.all(Array.from({ length: Math.min(threads, pieces.length) }, start));
}

/** The thread's side. @returns whether this is a thread of `shareWork` */
export function worksInThread(works: Readonly<Record<string, Work<never, never, unknown>>>): boolean {
  // Their types are known only here and in `shareWork`, which made them.
  const task = workerData as Task | null;
  if (isMainThread || !parentPort || !task?.isSharedWork) return false;
  const port: MessagePort = parentPort;
  const work = works[task.name](task.shared as never);
  port.on('message', async (message: { readonly piece?: unknown; readonly isOver?: true }) => {
    if (message.isOver) port.close();
    else port.postMessage({ result: await work(message.piece as never) } satisfies Answer);
  });
  port.postMessage({} satisfies Answer);
  return true;
}

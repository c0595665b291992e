/**
 * The characters of files, fetched and read once for all elements of a page that show them. One worker reads for all of
 * them, from the first element to the last. Where a page can have none (its policy allows none, or this script is from
 * another host), the page itself reads.
 */
import { adoptSkinFacts } from '../evaluate/skin/bounds.ts';
import { fetchFiles } from '../io/fetch-files.ts';
import { hasControls } from '../model/takes/take.ts';
import { WorkerClient, WorkerError } from '../worker/client.ts';
import type { GivenBlob, OpenOutput } from '../worker/protocol.ts';

/** What an element holds of the files that it shows. */
export interface Held {
  /** Rejects with an error whose message is a sentence. */
  readonly opened: Promise<OpenOutput>;
  /** Call once it isn't shown any more. */
  release(): void;
}

interface Shared {
  readonly opened: Promise<OpenOutput>;
  users: number;
}

/** By their addresses. */
const all = new Map<string, Shared>();

/** The files of these addresses. @param base of those that aren't whole */
export function holdFiles(addresses: readonly string[], base: string): Held {
  return hold(`${base}\n${addresses.join('\n')}`, () => fetchFiles(addresses, base));
}

/** Files that the page has itself. */
export function holdGiven(files: readonly GivenBlob[]): Held {
  return { opened: read(files), release: () => undefined };
}

function hold(key: string, find: () => Promise<readonly GivenBlob[]>): Held {
  const shared = all.get(key) ?? { opened: find().then(read), users: 0 };
  all.set(key, shared);
  shared.users++;
  return {
    opened: shared.opened,
    release: () => {
      if (--shared.users === 0 && all.get(key) === shared) all.delete(key);
    },
  };
}

async function read(given: readonly GivenBlob[]): Promise<OpenOutput> {
  // Workers need neither addresses nor versions.
  const files = given.map(({ path, blob }) => ({ path, blob }));
  const output = (await inWorker(files)) ?? (await inPage(files));
  for (const { skin, facts, morphs } of output.facts) adoptSkinFacts(skin, facts, morphs);
  // Takes with layers, goals or attachments can't be played before.
  if (output.characters.some(({ takes }) => takes.some(hasControls))) {
    const { provideLayers } = await import('../evaluate/layers.ts');
    provideLayers();
  }
  return output;
}

let elements = 0;
let client: WorkerClient | undefined;
let worker: Worker | undefined;
/** Whether this worker has begun to run. */
let hasBegun = false;
let hasNone = false;

/** An element is on the page, until the returned function is called: the last one ends the worker. */
export function useWorker(): () => void {
  elements++;
  return () => {
    if (--elements > 0) return;
    worker?.terminate();
    worker = client = undefined;
  };
}

/** Undefined if no worker can be started. */
async function inWorker(files: readonly GivenBlob[]): Promise<OpenOutput | undefined> {
  if (hasNone) return undefined;
  client ??= new WorkerClient(startWorker);
  try {
    return await client.run('open', { files });
  } catch (error) {
    if (hasBegun || !(error instanceof WorkerError)) throw error;
    hasNone = true;
    return undefined;
  }
}

async function inPage(files: readonly GivenBlob[]): Promise<OpenOutput> {
  const { openCharacters } = await import('./worker.ts');
  return openCharacters({ files });
}

function startWorker(): Worker {
  // In these words, by which bundlers find it.
  const made = new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });
  hasBegun = false;
  const note = () => {
    hasBegun = true;
  };
  made.addEventListener('message', note, { once: true });
  worker = made;
  return made;
}

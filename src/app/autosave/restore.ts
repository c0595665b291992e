/**
 * Reads a kept session: its files through the worker as when they were opened, and its arrays from their pieces. All or
 * nothing; the document isn't touched here.
 */
import { adoptSkinFacts } from '../../evaluate/skin/bounds.ts';
import { type KeptFile, SessionLostError, type SessionStore } from '../../io/session-store.ts';
import type { Character } from '../../model/document.ts';
import type { ParsedFile } from '../../model/files.ts';
import type { Runs } from '../../worker/client.ts';
import type { Progress } from '../../worker/protocol.ts';
import { decode, emptyNumbers, RestoreError, storedNumbers } from './decode.ts';
import type { Encoded, StorableNumbers, StoredNumbers } from './encoded.ts';
import { Keeper, type SessionHead } from './keeper.ts';
import { givenIn, type Origins } from './origins.ts';
import { fill, piecesOf } from './pieces.ts';
import type { KeptState, SessionState } from './session-state.ts';

export interface ReadOptions {
  readonly signal: AbortSignal;
  onProgress(progress: Progress): void;
}

/** Files that were opened together, read again. */
interface Opening {
  readonly given: readonly KeptFile[];
  readonly files: readonly ParsedFile[];
}

export interface ReadSession {
  readonly state: SessionState;
  /** A keeper to continue the session, which knows what the store already holds. */
  keeper(): Keeper;
}

/** Throws a `RestoreError`, or the error of the store or worker. */
export async function readSession(
  id: string,
  store: SessionStore,
  worker: Runs<'parse'>,
  origins: Origins,
  options: ReadOptions,
): Promise<ReadSession> {
  const content = await store.read(id);
  if (!content) throw new RestoreError('The session no longer exists.');
  // Written by `Keeper`, in the version that its card names.
  const head = content.head as SessionHead;
  const openings = await readOpenings(head, content.files, worker, options);
  const read = filesRead(openings);
  const files = head.files.map((file) => {
    if (!file) return undefined;
    const found = read.get(file.given)?.get(file.path);
    if (!found) throw new RestoreError(`${file.path} can no longer be read.`);
    return found;
  });
  const chunks = await readChunks(id, store, content.chunks);
  const arrays = await readArrays(id, store, [head.tree, ...[...chunks.values()].flat()]);
  options.signal.throwIfAborted();
  // Takes may have layers, goals or attachments.
  (await import('../../evaluate/layers.ts')).provideLayers();
  (await import('../../edit/follow/leaders.ts')).provideLeaders();
  // `Keeper` wrote it.
  const { knownSkins, ...state } = decode(head.tree, { files, arrays, chunks }) as KeptState;
  if (state.document.characters.some(isDriven)) {
    (await import('../../evaluate/retarget/driving.ts')).provideRetargeting();
    (await import('../../edit/follow/sources.ts')).provideSources();
  }
  for (const { skin, facts, morphs } of knownSkins) adoptSkinFacts(skin, facts, morphs);
  return {
    state,
    keeper: () => {
      const keeper = new Keeper(id, store, origins);
      keeper.isStored = true;
      for (const { given, files: read } of openings) origins.adopt(given, read);
      for (const file of content.files) keeper.files.adopt(file.id);
      for (const [place, array] of arrays) keeper.pieces.adopt(array, place);
      for (const piece of content.pieces) keeper.pieces.adoptWaste(piece);
      for (const chunk of content.chunks) keeper.chunks.adoptWaste(chunk);
      return keeper;
    },
  };
}

/** Whether retargeting moves a character, or one that it follows, which may be in the document no longer. */
function isDriven({ driver, leaders = [] }: Character): boolean {
  return driver !== undefined || leaders.some(isDriven);
}

/** By the id of the stored file, and by path in it. */
function filesRead(openings: readonly Opening[]): ReadonlyMap<number, ReadonlyMap<string, ParsedFile>> {
  const read = new Map<number, Map<string, ParsedFile>>();
  for (const { given, files } of openings) {
    const givenAt = givenIn(given);
    for (const { id } of given) read.set(id, new Map());
    for (const file of files) {
      const own = givenAt(file.source.path);
      if (own) read.get(own.id)?.set(file.source.path, file);
    }
  }
  return read;
}

async function readOpenings(
  head: SessionHead,
  kept: readonly KeptFile[],
  worker: Runs<'parse'>,
  { signal, onProgress }: ReadOptions,
): Promise<readonly Opening[]> {
  const needed = new Set([...head.files.flatMap((file) => file?.given ?? []), ...(head.beside ?? [])]);
  const together = new Map<number, KeptFile[]>();
  for (const file of kept) {
    if (!needed.has(file.id)) continue;
    const others = together.get(file.opening);
    if (others) others.push(file);
    else together.set(file.opening, [file]);
  }
  const openings: Opening[] = [];
  for (const given of together.values()) {
    const output = await worker.run('parse', { files: given.map((g) => g.given) }, { signal, onProgress });
    for (const { skin, facts, morphs } of output.facts) adoptSkinFacts(skin, facts, morphs);
    openings.push({ given, files: output.files });
  }
  return openings;
}

async function readChunks(
  id: string,
  store: SessionStore,
  chunks: readonly number[],
): Promise<ReadonlyMap<number, readonly Encoded[]>> {
  const read = new Map<number, readonly Encoded[]>();
  // Written by `Keeper`.
  await store.readChunks(id, chunks, (chunk, of) => read.set(chunk, of as readonly Encoded[]));
  return read;
}

async function readArrays(
  id: string,
  store: SessionStore,
  trees: readonly Encoded[],
): Promise<ReadonlyMap<StoredNumbers, StorableNumbers>> {
  const arrays = new Map<StoredNumbers, StorableNumbers>();
  // An array that several records refer to is one.
  const byPlace = new Map<string, StorableNumbers>();
  for (const place of storedNumbers(trees)) {
    const key = `${place.piece} ${place.bytes} ${place.type}`;
    const array = byPlace.get(key) ?? emptyNumbers(place);
    byPlace.set(key, array);
    arrays.set(place, array);
  }
  const wanted = new Map<number, StoredNumbers[]>();
  for (const place of arrays.keys()) {
    for (const piece of piecesOf(place)) wanted.set(piece, [...(wanted.get(piece) ?? []), place]);
  }
  try {
    await store.readPieces(id, [...wanted.keys()], (piece, bytes) => {
      for (const place of wanted.get(piece) ?? []) {
        const array = arrays.get(place);
        if (array) fill(array, place, piece, bytes);
      }
    });
  } catch (error) {
    throw error instanceof SessionLostError ? new RestoreError(error.message) : error;
  }
  return arrays;
}

/**
 * From files to the document: read in the worker, assembled, added as one step, shown. Files are opened one batch at a
 * time, in the order in which they were dropped.
 */

import { type Playback, pause, play } from '../edit/playback.ts';
import type { Store } from '../edit/store.ts';
import { frameRateOf } from '../evaluate/samples/frame-rate.ts';
import { adoptSkinFacts } from '../evaluate/skin/bounds.ts';
import { runToEnd, type Steps } from '../evaluate/steps.ts';
import { openingOf, skeletonKindFor } from '../files/kinds.ts';
import type { Keep } from '../files/open/layers.ts';
import { type DumpFile, type OpenResult, openInSteps } from '../files/open/open-in-steps.ts';
import type { GivenFile } from '../io/given.ts';
import { type Diagnostic, hasErrors, withoutPlace } from '../model/diagnostic.ts';
import { type Character, type Document, findCharacter, rangeOfTakes, shownTake } from '../model/document.ts';
import { sentenceOf } from '../model/failure.ts';
import { byFileName, type ParsedFile, type SourceFile } from '../model/files.ts';
import type { Messages } from '../ui/state/messages.ts';
import type { Loading, WorkbenchStage } from '../ui/state/workbench.ts';
import type { Observable } from '../ui/widgets/observable.ts';
import type { ViewCamera } from '../view/camera/view-camera.ts';
import { framedTimes } from '../view/shown-characters.ts';
import { runInSlices } from '../view/slices.ts';
import { type Runs, WorkerError } from '../worker/client.ts';
import type { GivenBlob, ParseOutput } from '../worker/protocol.ts';

export interface OpeningParts {
  readonly store: Store;
  readonly transport: Observable<Playback>;
  readonly messages: Messages;
  readonly loading: Observable<Loading | undefined>;
  readonly viewport: Pick<WorkbenchStage, 'prepare'>;
  readonly camera: Pick<ViewCamera, 'frameAll'>;
  readonly worker: Runs<'parse'>;
  /** Whether the user wants less motion: then new takes don't start to play. */
  reducesMotion(): boolean;
  /** Takes dumps that were opened, once their character is; absent: nothing is compared. */
  compare?(dumps: readonly DumpFile[]): void;
  /** Tells how new characters were taken whose file doesn't say; absent: nothing is told. */
  offerSpaces?(opened: readonly Character[]): void;
}

/** What one opening added to the document. */
export interface OpenedFiles {
  /** As opened: a zip is one file. */
  readonly given: readonly GivenFile[];
  /** What was read from them: the same objects as in the document. */
  readonly files: readonly ParsedFile[];
}

/** Files that were read before. */
export interface ReadFiles {
  readonly read: readonly ParsedFile[];
}

type Found = readonly GivenFile[] | ReadFiles;
/** Finds the files; may have to fetch them or walk folders first. */
export type FindFiles = (signal: AbortSignal) => Promise<Found> | Found;

export interface OpenOptions {
  /** The page's first character: no undo step, and replaced by anything that is opened. */
  readonly asOpeningSample?: boolean;
  /** The character whose files are reloaded: it keeps showing the same alternatives, and the files are for it. */
  readonly reloads?: string;
  /** What counts where a plain file was edited since it was saved with its layers; default: the user decides. */
  readonly keep?: Keep;
}

/** Views of less are made with the first picture of it: joints, and characters, each of which counts as some. */
const MANY_JOINTS = 4000;
const PER_CHARACTER = 40;
/** Diagnostics of files that have no errors but were not opened. */
const LEFT_ASIDE: ReadonlySet<string> = new Set(['held-back', 'file-unused', 'format-unknown']);

export class Opener {
  private readonly parts: OpeningParts;
  private last: Promise<unknown> = Promise.resolve();
  private readonly listeners = new Set<(opened: OpenedFiles) => void>();
  /** Given files that later ones may need, by their paths. */
  private readonly before = new Map<string, GivenFile>();
  private readonly givenListeners = new Set<(given: readonly GivenFile[]) => void>();

  constructor(parts: OpeningParts) {
    this.parts = parts;
  }

  /** Opens files and returns all diagnostics. Never rejects: failures are diagnostics too. */
  open(find: FindFiles, options: OpenOptions = {}): Promise<readonly Diagnostic[]> {
    return this.inTurn(() => this.openNow(find, options));
  }

  /** Runs work that must not overlap with opening files, in the same queue. */
  inTurn<T>(work: () => Promise<T>): Promise<T> {
    const turn = this.last.then(work);
    this.last = turn.catch(() => undefined);
    return turn;
  }

  /** Calls back after each opening that changed the document. Returns an unsubscribe function. */
  subscribe(listener: (opened: OpenedFiles) => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  /** Calls back with all files before they are read, also with those that turn out to have errors. */
  onGiven(listener: (given: readonly GivenFile[]) => void): void {
    this.givenListeners.add(listener);
  }

  private async openNow(find: FindFiles, options: OpenOptions): Promise<readonly Diagnostic[]> {
    const { loading, messages, worker } = this.parts;
    const abort = new AbortController();
    const cancel = () => abort.abort(new DOMException('Open cancelled.', 'AbortError'));
    loading.set({ label: 'files', done: 0, of: 0, cancel });
    try {
      const found = await find(abort.signal);
      abort.signal.throwIfAborted();
      const [files, read] = 'read' in found ? [[], found.read] : [found, []];
      if (files.length + read.length === 0) return [];
      for (const listener of this.givenListeners) listener(files);
      // Fetched while the files are read: what is opened is told before it is drawn, which may take longest.
      const isNoticed = options.reloads === undefined && !options.asOpeningSample;
      const noticing = isNoticed ? import('../files/open/unseen-changes.ts').catch(() => undefined) : undefined;
      // The worker doesn't need the handles.
      const blobs = files.map(({ path, blob }) => ({ path, blob }));
      const input = { files: blobs, before: await this.earlierFiles(), keep: options.keep };
      const output: ParseOutput =
        read.length > 0
          ? { files: read, broken: [], diagnostics: [], facts: [], keeps: [] }
          : await worker.run('parse', input, {
              signal: abort.signal,
              onProgress: (p) => loading.set({ label: p.label, done: p.done, of: p.of, cancel }),
            });
      for (const file of files) if (output.keeps.includes(file.path)) this.before.set(file.path, file);
      // A take that waited for its skeleton is not read again with the next one.
      for (const { source } of output.files) if (skeletonKindFor(source.path)) this.before.delete(source.path);
      for (const { skin, facts, morphs } of output.facts) adoptSkinFacts(skin, facts, morphs);
      // Nothing of them can be shown before.
      const layers = output.layers && (await import('./opened-layers.ts'));
      layers?.provideLayers();
      layers?.provideLeaders();
      const { store } = this.parts;
      // The user has opened something meanwhile, which takes precedence over the example.
      const isLate = () => options.asOpeningSample && store.document.characters.length > 0;
      if (isLate()) return [];
      const { reloads } = options;
      const result = await this.assembled(output, reloads, abort.signal);
      if (isLate()) return [];
      const before = store.document;
      const isChange = result.document !== before;
      const wasOpen = filesOf(store.document);
      const next = reloads === undefined ? result.document : showingTheSame(store.document, result.document);
      const label = reloads === undefined ? result.label : result.label.replace(/^Open/, 'Reload');
      this.put(next, result.opened, label, options);
      const earlier = this.earlierIn(output.files).filter(({ path }) => !files.some((file) => file.path === path));
      const given = [...files, ...earlier];
      // In the task of the change: what was opened would else count as unsaved before it was read.
      if (isChange) for (const listener of this.listeners) listener({ given, files: output.files });
      const diagnostics = [...output.diagnostics, ...result.diagnostics, ...(await lostIn(before, result))];
      // Clears the messages of files that are all right now, and of those that waited for them.
      const taken = before.unused.filter(({ file }) => !result.document.unused.some((unused) => unused.file === file));
      messages.report(
        diagnostics,
        [...sourcesOf(output.files), ...sourcesOf(taken.map(({ file }) => file))].map(({ name }) => name),
        (name, found) => outcomeOf(found, wasOpen.has(name)),
      );
      layers?.askWhatToKeep(output, options, this.parts, (again) => void this.open(() => found, again));
      if (result.dumps.length > 0) this.parts.compare?.(result.dumps);
      this.offerSpaces(result.opened.filter((id) => !findCharacter(before, id)));
      // Errors stay in the line instead: they say themselves what became of their files. The first character is seen.
      if (!hasErrors(diagnostics)) {
        const unseen = (await noticing)?.unseenChanges(before, result.document, output.files, output.diagnostics);
        if (unseen !== undefined) messages.note(unseen);
      }
      return diagnostics;
    } catch (error) {
      if (abort.signal.aborted) {
        messages.note('Open cancelled. Nothing was changed.');
        return [];
      }
      const diagnostic = failure(error);
      messages.report([diagnostic]);
      return [diagnostic];
    } finally {
      loading.set(undefined);
    }
  }

  /** @param fresh ids of new characters */
  private offerSpaces(fresh: readonly string[]): void {
    const { store, offerSpaces } = this.parts;
    const known = fresh.flatMap((id) => findCharacter(store.document, id) ?? []).filter((c) => c.space?.known);
    if (known.length > 0) offerSpaces?.(known);
  }

  /**
   * The document with what was read, put together between frames; at once if it has changed meanwhile.
   *
   * @throws the signal's reason if it is aborted
   */
  private async assembled(
    { files, broken }: ParseOutput,
    reloads: string | undefined,
    signal: AbortSignal,
  ): Promise<OpenResult> {
    const { store } = this.parts;
    store.settle();
    const { document, selection } = store;
    const beside = await openerBeside([...files, ...document.unused.map(({ file }) => file)]);
    signal.throwIfAborted();
    const open = (into: Document, selectedId = selection.characterId) =>
      openInSteps(into, files, broken, reloads ?? selectedId, byFileName, beside);
    const result = await runInSlices(this.withViews(open(document)), signal);
    signal.throwIfAborted();
    if (result && store.document === document) return result;
    store.settle();
    return runToEnd(open(store.document, store.selection.characterId));
  }

  /** Goes on with the views of new characters. */
  private *withViews(steps: Steps<OpenResult>): Steps<OpenResult> {
    const result = yield* steps;
    const { opened } = result;
    const document = this.parts.store.asReplaced(result.document);
    const characters = opened.flatMap((id) => findCharacter(document, id) ?? []);
    const size = characters.reduce((sum, { skeleton }) => sum + PER_CHARACTER + (skeleton?.joints.length ?? 0), 0);
    if (size > MANY_JOINTS) {
      const seen = document.characters.filter(({ isHidden }) => !isHidden);
      const times = framedTimes(rangeOfTakes(document) ?? this.parts.transport.get().range, seen);
      for (const character of characters) {
        yield 1;
        this.parts.viewport.prepare(character, times);
        // Who follows the document asks for all rates at once.
        const take = shownTake(character);
        if (take) frameRateOf(take);
      }
      yield 1;
    }
    return { ...result, document };
  }

  /** As they are on disk now, if the browser can tell. */
  private earlierFiles(): Promise<readonly GivenBlob[]> {
    const files = [...this.before.values()].map(async ({ path, blob, handle }) => ({
      path,
      blob: (await handle?.getFile().catch(() => undefined)) ?? blob,
    }));
    return Promise.all(files);
  }

  /** Those that later files may need that these were read from. */
  private earlierIn(files: readonly ParsedFile[]): readonly GivenFile[] {
    return sourcesOf(files).flatMap(({ path }) => this.before.get(path) ?? []);
  }

  /** Adds what was opened as one step, selected and framed if it is new. */
  put(document: Document, opened: readonly string[], label: string, options: OpenOptions = {}): void {
    const { store, transport, camera } = this.parts;
    const before = store.document;
    if (document === before) return;
    const { characterId } = store.selection;
    const [first] = opened;
    const isSelected = characterId !== undefined && opened.includes(characterId);
    const selected = first !== undefined && !isSelected ? { characterId: first } : undefined;
    if (options.asOpeningSample) {
      store.amend({ document: { ...document, isOpeningSample: true }, ...(selected && { selected }) });
    } else store.replace(label, { document, ...(selected && { selected }) });
    // A replaced part keeps time and camera: someone is editing a file on disk. New content may be of another size.
    if (opened.some((id) => hasGrown(findCharacter(before, id), findCharacter(document, id)))) camera.frameAll();
    // The range already follows the takes (`follow-range.ts`); new ones play from the start, if motion is welcome.
    if (opened.some((id) => hasNewTake(before, document, id))) {
      transport.update((now) => {
        const atStart = { ...now, timeSeconds: now.range[0], rate: Math.abs(now.rate) || 1 };
        return this.parts.reducesMotion() ? pause(atStart, false) : play(atStart);
      });
    }
  }
}

/** Keeps the shown alternatives (skins, takes) if they still exist. */
export function showingTheSame(before: Document, after: Document): Document {
  const characters = after.characters.map((character) => {
    const was = findCharacter(before, character.id);
    if (!was) return character;
    const sameTake = was.shownTake < 0 || character.takes[was.shownTake]?.name === was.takes[was.shownTake]?.name;
    const sameSkin = character.skins[was.shownSkin]?.name === was.skins[was.shownSkin]?.name;
    const shownTake = sameTake ? was.shownTake : character.shownTake;
    const shownSkin = sameSkin ? was.shownSkin : character.shownSkin;
    if (shownTake === character.shownTake && shownSkin === character.shownSkin) return character;
    return { ...character, shownTake, shownSkin };
  });
  return after === before ? after : { ...after, characters };
}

/** Whether a character is new, or has its first part of some kind. */
function hasGrown(before: Character | undefined, after: Character | undefined): boolean {
  if (!before || !after) return true;
  const first = (was: readonly unknown[], is: readonly unknown[]) => was.length === 0 && is.length > 0;
  return before.skeleton === undefined || first(before.skins, after.skins) || first(before.takes, after.takes);
}

/** Whether a character plays a take that it didn't have before. */
function hasNewTake(before: Document, after: Document, id: string): boolean {
  const take = shownTakeOf(after, id);
  if (!take) return false;
  const old = findCharacter(before, id);
  return !old?.takes.some((c) => c.name === take.name);
}

function shownTakeOf(document: Document, id: string) {
  const character = findCharacter(document, id);
  return character && shownTake(character);
}

/** With the further files that they were read from. */
function sourcesOf(files: readonly ParsedFile[]): readonly SourceFile[] {
  return files.flatMap(({ source, beside = [] }) => [source, ...beside]);
}

/** Names of the files that the characters came from. */
function filesOf({ characters }: Document): ReadonlySet<string> {
  return new Set(characters.flatMap((c) => c.sources.map((source) => source.name)));
}

/** What became of a file with these diagnostics; undefined if it was left aside. */
function outcomeOf(found: readonly Diagnostic[], wasOpen: boolean): string | undefined {
  if (found.some(({ code }) => code === 'opened-without')) return 'not opened; the character was opened without it';
  if (hasErrors(found)) return wasOpen ? 'not opened; the previous version is kept' : 'not opened';
  return found.some(({ code }) => LEFT_ASIDE.has(code)) ? undefined : 'opened';
}

function failure(error: unknown): Diagnostic {
  const message = sentenceOf(error);
  const code = error instanceof WorkerError ? 'worker-failed' : 'open-failed';
  return withoutPlace('error', code, `Nothing was opened. ${message}`, '');
}

/** What characters have lost whose skeleton was loaded again: of most openings there is none. */
async function lostIn(before: Document, { document, opened }: OpenResult): Promise<readonly Diagnostic[]> {
  const isAgain = (id: string) => findCharacter(before, id)?.skeleton !== findCharacter(document, id)?.skeleton;
  if (!opened.some((id) => findCharacter(before, id) && isAgain(id))) return [];
  return (await import('../files/open/lost-over.ts')).lostOver(before, document, byFileName);
}

/** What opens JSON beside other files, if any of these is such: of most there is none. */
async function openerBeside(files: readonly ParsedFile[]) {
  if (!files.some(({ kind }) => openingOf(kind).as === 'beside')) return undefined;
  return (await import('../files/open/beside-files.ts')).openBeside;
}

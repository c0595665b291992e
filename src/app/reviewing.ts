/**
 * Takes given by the hundred: they are listed for review at once, and read one after the other in a worker, those in
 * view first. Only their files and what the list shows of them are kept; a take that is shown is read again.
 */

import { addToReview, readReview } from '../edit/commands/review.ts';
import type { Store } from '../edit/store.ts';
import { provideLayers } from '../evaluate/layers.ts';
import { formatKindOf, isBesideTakes, isReviewable, KINDS, openingOf } from '../files/kinds.ts';
import { openFiles } from '../files/open/open-files.ts';
import type { GivenFile } from '../io/given.ts';
import { type Character, EMPTY_DOCUMENT } from '../model/document.ts';
import { sentenceOf } from '../model/failure.ts';
import { baseName } from '../model/files.ts';
import type { TakeDigest } from '../review/digest.ts';
import { matchPaths } from '../review/match-paths.ts';
import { isTakeList, readList } from '../review/read-list.ts';
import { attempt } from '../ui/state/actions/attempt.ts';
import type { Messages } from '../ui/state/messages.ts';
import { openPanel } from '../ui/state/panels/panels.ts';
import { MAX_OPENED, type ReviewFiles, type ReviewProgress } from '../ui/state/review.ts';
import type { Settings } from '../ui/state/settings.ts';
import type { Timeline } from '../ui/state/timeline.ts';
import { plural } from '../ui/widgets/numbers/number-text.ts';
import { type Observable, observable } from '../ui/widgets/observable.ts';
import type { Runs } from '../worker/client.ts';
import type { GivenBlob } from '../worker/protocol.ts';
import type { Opener } from './opening.ts';

/** Files of a batch: in view ones wait for one batch at most. */
const BATCH = 4;
/** Bytes of a file that say whether it is a list of takes. */
const SNIFFED = 4096;
/** Characters kept to be shown again. */
const KEPT = 3;

export interface ReviewingParts {
  readonly store: Store;
  readonly messages: Pick<Messages, 'note' | 'report'>;
  readonly timeline: Timeline;
  readonly settings: Observable<Settings>;
  readonly opener: Pick<Opener, 'open'>;
  readonly worker: Runs<'parse' | 'review' | 'unpack'>;
}

/**
 * Takes what is for review out of the given files: takes, if there are many or the list has them, and lists.
 * @returns the others, to be opened
 */
export async function takeForReview(
  parts: ReviewingParts,
  asGiven: readonly GivenFile[],
): Promise<readonly GivenFile[]> {
  const given = (await Promise.all(asGiven.map((file) => withTakesOut(parts, file)))).flat();
  const isTake = ({ path }: GivenFile) => isReviewable(path);
  const takes = given.filter(isTake);
  const lists = await listsIn(given);
  const others = given.filter((file) => !isTake(file) && !lists.some((list) => list.file === file));
  const listed = new Set(parts.store.document.review?.map(({ path }) => path));
  const isMany = takes.length > MAX_OPENED;
  const reviewed = isMany ? takes : takes.filter(({ path }) => listed.has(path));
  const opened = isMany ? [] : takes.filter((file) => !reviewed.includes(file));
  if (reviewed.length > 0) {
    filesOf(parts).add(
      reviewed,
      given.filter(({ path }) => isBesideTakes(path)),
    );
    const paths = reviewed.map(({ path }) => path);
    attempt(parts.messages, () => parts.store.apply(addToReview, { paths }));
    showTab(parts);
    if (isMany) parts.messages.note(`${takes.length} takes are listed in the Review tab. Open the ones you need.`);
  }
  for (const { file, text } of lists) read(parts, file.path, text);
  // Beside takes for review, a folder's readmes are not worth a message.
  return reviewed.length > 0 || lists.length > 0 ? [...opened, ...others.filter(isForCharacters)] : given;
}

/** The takes of a zip that has many, in its place. */
async function withTakesOut({ worker }: ReviewingParts, file: GivenFile): Promise<readonly GivenFile[]> {
  if (!/\.zip$/i.test(file.path)) return [file];
  const { takes } = await worker.run('unpack', { zip: { path: file.path, blob: file.blob }, most: MAX_OPENED });
  const { version } = file;
  return takes.length > 0 ? takes.map((take) => ({ ...take, ...(version !== undefined && { version }) })) : [file];
}

/** Whether a file is worth opening beside takes for review; skeletons of these are read with them. */
function isForCharacters({ path }: GivenFile): boolean {
  if (/\.zip$/i.test(path)) return true;
  const kind = formatKindOf(path);
  if (!kind || isBesideTakes(path)) return false;
  const { as } = openingOf(KINDS[kind].content);
  return as !== 'texture' && as !== 'dump' && as !== 'beside' && as !== 'layers';
}

async function listsIn(given: readonly GivenFile[]) {
  const lists: { readonly file: GivenFile; readonly text: string }[] = [];
  for (const file of given) {
    if (!/\.(csv|json)$/i.test(file.path)) continue;
    if (!isTakeList(await file.blob.slice(0, SNIFFED).text())) continue;
    lists.push({ file, text: await file.blob.text() });
  }
  return lists;
}

/** Takes a list's verdicts over; without takes in review, its own become the list. */
function read(parts: ReviewingParts, path: string, text: string): void {
  const { store, messages } = parts;
  const { takes, diagnostics } = readList(text, baseName(path));
  messages.report(diagnostics, [baseName(path)]);
  if (takes.length === 0) return;
  if ((store.document.review ?? []).length === 0) {
    attempt(messages, () => store.apply(addToReview, { paths: takes.map((take) => take.path) }));
    filesOf(parts);
  }
  const paths = (store.document.review ?? []).map((take) => take.path);
  const { found, missing } = matchPaths(takes, paths);
  const said = [...found].map(([own, { verdict, stars, tags, notes }]) => ({ path: own, verdict, stars, tags, notes }));
  attempt(messages, () => store.apply(readReview, { takes: said }));
  parts.timeline.review.areSaved(said);
  showTab(parts);
  const left =
    missing.length > 0
      ? `; ${plural(missing.length, 'take in that list is', 'takes in that list are')} not in review`
      : '';
  messages.note(`Applied ${baseName(path)} to ${plural(found.size, 'take')}${left}.`);
}

function showTab(parts: ReviewingParts): void {
  openPanel(parts, 'timeline', true);
  parts.timeline.change({ tab: 'review' });
}

function filesOf(parts: ReviewingParts): TakeFiles {
  const { files } = parts.timeline.review;
  const known = files.get();
  if (known instanceof TakeFiles) return known;
  const made = new TakeFiles(parts);
  files.set(made);
  return made;
}

class TakeFiles implements ReviewFiles {
  readonly progress = observable<ReviewProgress>({ done: 0, of: 0 });
  private readonly given = new Map<string, GivenFile>();
  /** Skeletons of takes, by their paths. */
  private readonly beside = new Map<string, GivenFile>();
  private readonly digests = new Map<string, TakeDigest>();
  private wanted: readonly string[] = [];
  private waiting: string[] = [];
  private isReading = false;
  /** The last ones shown, the latest last. */
  private readonly characters = new Map<string, Promise<Character | undefined>>();

  constructor(private readonly parts: ReviewingParts) {}

  add(files: readonly GivenFile[], beside: readonly GivenFile[]): void {
    for (const file of beside) this.beside.set(file.path, file);
    for (const file of files) {
      const { path } = file;
      if (this.given.get(path)?.version !== file.version) {
        this.digests.delete(path);
        this.characters.delete(path);
      }
      this.given.set(path, file);
    }
    this.waiting = [...this.given.keys()].filter((path) => !this.digests.has(path));
    this.tell();
    void this.read();
  }

  has(path: string): boolean {
    return this.given.has(path);
  }

  digest(path: string): TakeDigest | undefined {
    return this.digests.get(path);
  }

  want(paths: readonly string[]): void {
    this.wanted = paths;
  }

  character(path: string): Promise<Character | undefined> {
    const known = this.characters.get(path);
    const found = known ?? this.parse(path);
    this.characters.delete(path);
    this.characters.set(path, found);
    for (const oldest of [...this.characters.keys()].slice(0, -KEPT)) this.characters.delete(oldest);
    return found;
  }

  open(paths: readonly string[]): void {
    const takes = paths.flatMap((path) => this.given.get(path) ?? []);
    const files = [...this.beside.values(), ...takes];
    void this.parts.opener.open(() => files);
  }

  private async parse(path: string): Promise<Character | undefined> {
    const file = this.given.get(path);
    if (!file) return undefined;
    const output = await this.parts.worker.run('parse', {
      files: [{ path, blob: file.blob }],
      before: this.blobsBeside(),
    });
    if (output.layers) provideLayers();
    const [first] = openFiles(EMPTY_DOCUMENT, output.files, output.broken).document.characters;
    // Of its own, so that nothing takes it for one of the document.
    return first && { ...first, id: 'review' };
  }

  private blobsBeside(): readonly GivenBlob[] {
    return Array.from(this.beside.values(), ({ path, blob }) => ({ path, blob }));
  }

  /** Until all have been read. */
  private async read(): Promise<void> {
    if (this.isReading) return;
    this.isReading = true;
    for (let batch = this.next(); batch.length > 0; batch = this.next()) {
      const files = batch.flatMap((path) => {
        const file = this.given.get(path);
        return file ? [{ path, blob: file.blob }] : [];
      });
      try {
        const { takes } = await this.parts.worker.run('review', { files, beside: this.blobsBeside() });
        for (const take of takes) this.digests.set(take.path, take);
      } catch (error) {
        const problem = sentenceOf(error);
        for (const { path } of files) this.digests.set(path, { path, problem });
      }
      this.tell();
    }
    this.isReading = false;
  }

  private next(): readonly string[] {
    const first = this.wanted.filter((path) => this.given.has(path) && !this.digests.has(path)).slice(0, BATCH);
    if (first.length > 0) return first;
    const batch: string[] = [];
    while (batch.length < BATCH && this.waiting.length > 0) {
      const path = this.waiting.shift();
      if (path !== undefined && !this.digests.has(path)) batch.push(path);
    }
    return batch;
  }

  private tell(): void {
    this.progress.set({ done: this.digests.size, of: this.given.size });
  }
}

/** Actions on files in the menus, over dialogs, drops, examples and the disk. */
import { isReviewable } from '../files/kinds.ts';
import { pickFiles, pickFolder } from '../io/disk-files.ts';
import { fromDataTransfer, type GivenFile } from '../io/given.ts';
import { onDemand, whenIdle } from '../ui/state/on-demand.ts';
import { MAX_OPENED } from '../ui/state/review.ts';
import type { FileActions, SampleEntry, Sharing, Uses } from '../ui/state/workbench.ts';
import type { Runs } from '../worker/client.ts';
import type { PageJob } from '../worker/protocol.ts';
import { forMessage } from '../worker/tracked-takes.ts';
import { canReload, type DiskHandles } from './disk-handles.ts';
import type { SampleSwitches } from './example-display.ts';
import { type BundledExample, fetchSample } from './examples.ts';
import type { Opener } from './opening.ts';
import type { ReloadParts } from './reload.ts';
import type { ReviewingParts } from './reviewing.ts';
import type { Disk, Saver } from './saver.ts';
import { SourceTexts } from './source-texts.ts';
import type { Unsaved } from './unsaved.ts';
import { withReview } from './unsaved-review.ts';

interface Parts extends Pick<ReloadParts, 'store'>, ReviewingParts {
  readonly messages: Uses<'messages'>['messages'];
  readonly opener: Opener;
  readonly samples: Promise<readonly BundledExample[]>;
  /** Switches the display to what an example asks for. */
  readonly showSample: (shows: SampleSwitches | undefined) => void;
  readonly unsaved: Unsaved;
  readonly handles: DiskHandles;
  readonly disk: Pick<Disk, 'download'>;
  readonly framesPerSecond: () => number;
  readonly loading: Uses<'loading'>['loading'];
  /** What is in pictures. */
  readonly pictured: Uses<'viewport' | 'transport'>;
  readonly worker: Runs<PageJob>;
}

export function fileActions(parts: Parts): FileActions {
  const { opener, samples, unsaved } = parts;
  let listed: readonly SampleEntry[] = [];
  samples.then((list) => {
    listed = list;
  });
  const source = new SourceTexts({
    worker: parts.worker,
    handles: parts.handles,
    readAgain: readHere,
    async edits(texts) {
      const { FileEdits } = await import('./text-edits.ts');
      return new FileEdits({ ...parts, texts });
    },
  });
  opener.onGiven((given) => source.note(given));
  opener.subscribe(() => source.noteOpened(parts.store.document));
  let saver: Saver | undefined;
  /** Loaded on the first save, with everything that writes files. */
  const saving = async (save: (saver: Saver) => Promise<void>) => {
    const scripts = () => Promise.all([import('./saver.ts'), import('../io/disk-access.ts')]);
    const loaded = await onDemand(parts.messages, 'File saving', scripts);
    if (!loaded) return;
    const [{ Saver }, access] = loaded;
    saver ??= new Saver({
      ...parts,
      disk: { ...access, ...parts.disk },
      onWritten: (path, content) => source.noteWritten(path, content, parts.store.document),
    });
    await save(saver);
  };
  loadSavingOnceNeeded(parts);
  const openFound = (found: Promise<readonly GivenFile[]>) => {
    const files = withoutReviewed(parts, found);
    return opener.open(() => files);
  };
  // Read at once: the browser invalidates the files when the event is over.
  const take = (data: DataTransfer) => openFound(fromDataTransfer(data));
  return {
    // The dialog runs before the opening takes its turn, so that it blocks no other.
    open: () => void pickFiles().then((files) => openFound(Promise.resolve(files))),
    openFolder: () => void pickFolder().then((files) => openFound(Promise.resolve(files))),
    openSample(id) {
      opener.open(async (signal) => {
        const sample = (await samples).find((s) => s.id === id);
        if (!sample) throw new Error(`There is no example "${id}".`);
        const files = await fetchSample(sample, document.baseURI, signal);
        parts.showSample(sample.shows);
        return files;
      });
    },
    saveKit: () => void saveKit(parts),
    get samples() {
      return listed;
    },
    drop: take,
    paste: take,
    unsaved: withReview(unsaved.parts, parts.store, parts.timeline.review),
    saveChanged: () => void saving((s) => s.saveChanged()),
    save: (characterId, kind) => void saving((s) => s.saveAs(characterId, kind)),
    saveText: (name, text) => parts.disk.download(name, new Blob([text])),
    saveAll: (characterId) => void saving((s) => s.saveAll(characterId)),
    saveEverything: () => void saving((s) => s.saveEverything()),
    makeExchange: ({ format, character, options }, { signal, onProgress }) =>
      parts.worker.run(
        'exchange',
        { format, character: forMessage(character), options },
        { signal, onProgress: ({ done, of }) => onProgress(done / of) },
      ),
    saveBytes: (name, bytes, mime) => void saving((s) => s.saveBytes(name, bytes, mime)),
    reload: (characterId) => void reload(parts, characterId),
    canReload: (characterId) => canReload(parts.store.document, parts.handles, characterId),
    source,
    sharing: () => sharing(parts),
    async pictures() {
      const module = await onDemand(parts.messages, 'Picture export', () => import('./pictures.ts'));
      return module?.picturesOf(parts.pictured, (name, content) => parts.disk.download(name, content));
    },
  };
}

/** A file whose address is relative to the page. */
const readHere: ReloadParts['readAgain'] = async (file, signal) =>
  (await import('../io/disk-access.ts')).readAgain(file, document.baseURI, signal);

async function reload(parts: Parts, characterId: string): Promise<void> {
  const module = await onDemand(parts.messages, 'Reloading', () => import('./reload.ts'));
  await module?.reload({ ...parts, readAgain: readHere }, characterId);
}

async function sharing(parts: Parts): Promise<Sharing | undefined> {
  const module = await onDemand(parts.messages, 'Sharing', () => import('./sharing.ts'));
  return module?.sharingOf({ ...parts, ...parts.pictured });
}

async function saveKit({ worker, messages, disk }: Parts): Promise<void> {
  const made = async () => (await import('./kit-zip.ts')).kitZip(worker);
  const zip = await onDemand(messages, 'The test kit', made);
  if (zip) disk.download(zip.name, new Blob([zip.bytes], { type: 'application/zip' }));
}

/** Without what is for review: takes by the hundred, and lists of them. */
async function withoutReviewed(parts: Parts, found: Promise<readonly GivenFile[]>): Promise<readonly GivenFile[]> {
  const files = await found;
  const isPlain =
    !files.some(({ path }) => /\.(csv|json|zip)$/i.test(path)) &&
    files.filter(({ path }) => isReviewable(path)).length <= MAX_OPENED;
  if (isPlain && !parts.store.document.review) return files;
  const module = await onDemand(parts.messages, 'The review', () => import('./reviewing.ts'));
  return module ? module.takeForReview(parts, files) : files;
}

/** What is unsaved can be saved then, too, if the connection or the server has gone. */
function loadSavingOnceNeeded(parts: Parts): void {
  const stop = parts.unsaved.parts.subscribe(() => {
    stop();
    whenIdle(parts, () => {
      // Browsers try no script twice.
      if (!navigator.onLine) return;
      const scripts = Promise.all([import('./saver.ts'), import('./zip-character.ts')]);
      // Told when they are needed.
      scripts.catch(() => undefined);
    });
  });
}

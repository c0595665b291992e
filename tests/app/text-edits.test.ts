import { describe, expect, it } from 'vitest';
import { Opener } from '../../src/app/opening.ts';
import { SourceTexts } from '../../src/app/source-texts.ts';
import { FileEdits } from '../../src/app/text-edits.ts';
import { Unsaved } from '../../src/app/unsaved.ts';
import { DEFAULT_PLAYBACK } from '../../src/edit/playback.ts';
import { Store } from '../../src/edit/store.ts';
import { openFiles } from '../../src/files/open/open-files.ts';
import { savedFileOf } from '../../src/files/save/output.ts';
import { ownedIn } from '../../src/files/save/owned.ts';
import { jointPose } from '../../src/files/save/saved-poses.ts';
import { writeParts } from '../../src/files/save/saving.ts';
import { EMPTY_DOCUMENT } from '../../src/model/document.ts';
import type { ParsedFile } from '../../src/model/files.ts';
import { Messages } from '../../src/ui/state/messages.ts';
import { MAX_TEXT_BYTES } from '../../src/ui/state/source.ts';
import type { Loading } from '../../src/ui/state/workbench.ts';
import { observable } from '../../src/ui/widgets/observable.ts';
import { realFiles } from '../formats/real-files.ts';
import { parsed } from '../helpers/parsed.ts';
import { describeShared, sharedBytes } from '../helpers/shared.ts';
import { InThisThread } from './in-this-thread.ts';

const SKEL = 'balljoint a {\n\toffset 0 0 0\n\tballjoint b {\n\t\toffset 0 1 0\n\t\trotxlimit -1 1\n\t}\n}\n';

class Opened {
  readonly store = new Store();
  readonly unsaved = new Unsaved(this.store);
  readonly messages = new Messages();
  readonly texts = new SourceTexts({
    worker: new InThisThread(),
    handles: { at: () => undefined },
    readAgain: () => Promise.reject(new Error('Nothing is on disk.')),
    edits: () => Promise.reject(new Error('They are here.')),
  });
  readonly edits: FileEdits;
  framed = 0;

  constructor(
    readonly path: string,
    readonly text: string,
    beside: readonly ParsedFile[] = [],
  ) {
    const files = [...beside, parsed(path, text)];
    this.store.replace('Open', { document: openFiles(EMPTY_DOCUMENT, files).document });
    this.unsaved.opened(files);
    this.texts.note([{ path, blob: new Blob([text]) }]);
    this.texts.noteOpened(this.store.document);
    const { store, unsaved, texts, messages } = this;
    const opener = new Opener({
      ...{ store, messages, worker: new InThisThread(), transport: observable(DEFAULT_PLAYBACK) },
      ...{ loading: observable<Loading | undefined>(undefined), reducesMotion: () => true },
      viewport: { prepare: () => undefined },
      camera: { frameAll: () => void this.framed++ },
    });
    this.edits = new FileEdits({ store, unsaved, texts, messages, opener, worker: new InThisThread() });
  }

  saved(): string {
    const { source } = parsed(this.path, this.text);
    return savedFileOf(writeParts(source.name, ownedIn(this.store.document, this.path, jointPose))).text;
  }
}

describe('a text that is edited', () => {
  it('replaces the part as one step, which keeps it unsaved, selected and undone to the last byte', async () => {
    const { store, edits, unsaved, saved } = bound(new Opened('x/a.skel', SKEL));
    const [{ id }] = store.document.characters;
    store.select({ characterId: id, joint: 1 });
    const [before, written] = [store.document, saved()];
    const edited = SKEL.replace('0 1 0', '0 1.5 0').replace('-1 1', '-1 0.5');
    const { apply, diagnostics, isSame } = await edits.check('x/a.skel', edited, SKEL);
    expect([diagnostics, isSame]).toEqual([[], false]);
    expect(store.document).toBe(before);
    expect(apply?.()).toBe(true);
    expect(store.undoLabel).toBe('Edit text of a.skel');
    expect(store.selection).toMatchObject({ characterId: id, joint: 1 });
    expect(unsaved.current()).toMatchObject([{ characterId: id, kind: 'skel' }]);
    const after = store.document;
    expect(after.characters[0].parts?.skeleton?.id).toBe(before.characters[0].parts?.skeleton?.id);
    expect((await edits.changes('x/a.skel')).hunks).toMatchObject([{ oldFrom: 4, oldTo: 6, newFrom: 4, newTo: 6 }]);

    store.undo();
    expect(store.document).toBe(before);
    expect(saved()).toBe(written);
    expect(unsaved.current()).toEqual([]);
    expect((await edits.changes('x/a.skel')).hunks).toEqual([]);
    store.redo();
    expect(store.document).toBe(after);
  });

  it('is told to be the same if only blanks and the digits of numbers differ', async () => {
    const { edits } = new Opened('a.skel', SKEL);
    expect(await edits.check('a.skel', SKEL.replace('0 1 0', '0   1.00 0'), SKEL)).toMatchObject({ isSame: true });
    expect(await edits.check('a.skel', SKEL.replace('0 1 0', '0 1.01 0'), SKEL)).toMatchObject({ isSame: false });
  });

  it('can’t be applied with errors, which have their lines, nor if it doesn’t fit the rest', async () => {
    const { store, edits } = new Opened('a.skel', SKEL);
    const before = store.document;
    const broken = await edits.check('a.skel', SKEL.replace('0 1 0', '0 x 0'), SKEL);
    expect(broken.apply).toBeUndefined();
    expect(broken.diagnostics).toMatchObject([{ severity: 'error', line: 4, file: 'a.skel' }]);
    const skin = 'positions 1 {\n0 0 0\n}\nnormals 1 {\n0 1 0\n}\nskinweights 1 {\n1 1 1\n}\ntriangles 0 {\n}\n';
    const matrix = 'matrix {\n1 0 0\n0 1 0\n0 0 1\n0 0 0\n}\n';
    const whole = `${skin}bindings 2 {\n${matrix}${matrix}}\n`;
    const dressed = new Opened('a.skin', whole, [parsed('a.skel', SKEL)]);
    const unfit = await dressed.edits.check('a.skin', whole.replace('1 1 1', '1 7 1'), whole);
    expect(unfit.apply).toBeUndefined();
    expect(unfit.diagnostics.some(({ severity }) => severity === 'error')).toBe(true);
    expect(store.document).toBe(before);
  });

  it('changes the opening example instead of making way for it', async () => {
    const { store, edits } = new Opened('a.skel', SKEL, [parsed('b.skel', SKEL)]);
    store.amend({ ...store.document, isOpeningSample: true });
    const { apply } = await edits.check('a.skel', SKEL.replace('0 1 0', '0 2 0'), SKEL);
    expect(apply?.()).toBe(true);
    expect(store.document.characters.map(({ name }) => name)).toEqual(['b', 'a']);
  });

  it('that had errors is opened once it has none, framed, unsaved, and without their messages', async () => {
    const opened = new Opened('a.skel', SKEL);
    const { store, edits, texts, messages, unsaved } = opened;
    const broken = SKEL.replace('0 1 0', '0 x 0');
    for (const name of ['a.skel', 'b.skel']) {
      texts.note([{ path: name, blob: new Blob([broken]) }]);
      const wrong = await edits.check(name, `${broken}\n`, broken);
      expect(wrong.apply).toBeUndefined();
      messages.report(wrong.diagnostics);
      const { apply } = await edits.check(name, SKEL.replace('0 1 0', '0 3 0'), broken);
      expect(apply?.()).toBe(true);
      expect(messages.list.get().flatMap(({ diagnostics }) => diagnostics)).toEqual([]);
      expect(await (await edits.changes(name)).hunks).toEqual([]);
    }
    expect(store.document.characters.map(({ skeleton }) => skeleton?.joints[1].offset[1])).toEqual([3, 3]);
    expect(unsaved.current().map(({ name }) => name)).toEqual(['a.skel', 'b.skel']);
    expect(opened.framed).toBe(1);
    expect(await texts.given('b.skel')?.text()).toContain('0 3 0');
  });

  it('shows no changes of a file that nothing is saved in', async () => {
    expect(await new Opened('a.skel', SKEL).edits.changes('b.skel')).toEqual({ hunks: [] });
  });

  it('is compared up to a size, and says which', async () => {
    const { texts, edits } = new Opened('a.skel', SKEL);
    texts.note([{ path: 'a.skel', blob: new Blob([new Uint8Array(MAX_TEXT_BYTES + 1)]) }]);
    await expect(edits.changes('a.skel')).rejects.toThrow(
      'Changes can be shown in files of up to 5.0 MB; this one has 5.0 MB.',
    );
  });
});

/** A file of each kind, with those that it needs. */
const EXAMPLES: readonly (readonly [path: string, beside: readonly string[]])[] = [
  ['data/cse169/wasp.skel', ['data/cse169/wasp.skin']],
  ['data/cse169/tube.skin', ['data/cse169/tube.skel']],
  ['data/cse169/head1.morph', ['data/cse169/head.skel', 'data/cse169/head.skin']],
  ['data/cse169/wasp_walk.anim', ['data/cse169/wasp.skel']],
  ['data/axis-skel/arm3.axskel', []],
  ['data/bvh/poser-sl-walk.bvh', []],
];

describeShared('texts of real files that are edited', () => {
  const textOf = (path: string) => new TextDecoder().decode(sharedBytes(path));

  it('a number in a file of each kind is one changed line, undone to the last byte', async () => {
    const examples = EXAMPLES.map(
      ([path, beside]) =>
        new Opened(
          path,
          textOf(path),
          beside.map((p) => parsed(p, textOf(p))),
        ),
    );
    const [poses] = realFiles().get('pose') ?? [];
    const wasp = parsed('data/cse169/wasp.skel', textOf('data/cse169/wasp.skel'));
    for (const opened of [...examples, new Opened(poses.name, poses.text, [wasp])]) {
      const { path, text, edits, store } = opened;
      const written = opened.saved();
      const [before, count] = [store.document, store.document.characters.length];
      const edited = withOneNumberMore(text);
      const { apply, isSame, diagnostics } = await edits.check(path, edited, text);
      expect([isSame, apply !== undefined, diagnostics.filter(({ severity }) => severity === 'error')], path).toEqual([
        ...[false, true, []],
      ]);
      expect(apply?.(), path).toBe(true);
      expect(store.document.characters, path).toHaveLength(count);
      const { hunks, changed } = await edits.changes(path);
      expect(hunks, path).toHaveLength(1);
      expect(await changed?.text.text(), path).toBe(edited);
      store.undo();
      expect(store.document).toBe(before);
      expect(opened.saved(), path).toBe(written);
      // Nothing but its own part was replaced.
      store.redo();
      expect(store.document.characters.map(({ skins, takes }) => [skins.length, takes.length])).toEqual(
        before.characters.map(({ skins, takes }) => [skins.length, takes.length]),
      );
    }
  });
});

/** The middle one of the numbers that aren't whole, a little larger. */
function withOneNumberMore(text: string): string {
  const numbers = [...text.matchAll(/-?\d*\.\d+/g)];
  const { 0: number, index } = numbers[numbers.length >> 1];
  return `${text.slice(0, index)}${Number(number) + 0.125}${text.slice(index + number.length)}`;
}

function bound(opened: Opened) {
  return { ...opened, store: opened.store, unsaved: opened.unsaved, saved: () => opened.saved() };
}

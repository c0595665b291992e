/**
 * `<marrow-viewer>`: characters in anybody's page, evaluated and drawn by the workbench's own code.
 *
 *     <marrow-viewer src="wasp.skel wasp.skin wasp_walk.anim" autoplay loop controls></marrow-viewer>
 *
 * It reads when it is put into a page, and draws and plays while it is seen. Taken out, it gives everything back.
 */
import { DEFAULT_PLAYBACK, intoRange, type Playback, pause, play, stepFrames } from '../edit/playback.ts';
import { type Diagnostic, hasErrors } from '../model/diagnostic.ts';
import { type Character, type Document, EMPTY_DOCUMENT, rangeOfTakes } from '../model/document.ts';
import { sentenceOf } from '../model/failure.ts';
import type { Display } from '../model/session.ts';
import { oncePerFrame } from '../ui/widgets/frame.ts';
import { numbersOf } from '../view/camera/view-numbers.ts';
import { SharedView } from '../view/shared-view.ts';
import type { OpenOutput } from '../worker/protocol.ts';
import {
  ATTRIBUTES,
  type AttributeName,
  addressesIn,
  cameraOf,
  displayOf,
  numberOf,
  showingTake,
} from './attributes.ts';
import { backgroundOf } from './background.ts';
import { type KeyTarget, listenToKeys } from './keys.ts';
import { Parts } from './parts.ts';
import { Player } from './player.ts';
import { type Held, holdFiles, holdGiven, useWorker } from './reading.ts';
import { adoptStyle } from './style.ts';

/** What `load` and `error` say of the files. */
export interface ReadDetail {
  /** The words that are shown; empty with `load`. */
  readonly message: string;
  readonly diagnostics: readonly Diagnostic[];
}

/** A file that a page has itself. */
export interface ViewedFile {
  /** `wasp.skel`, or with folders, `/` between them. */
  readonly name: string;
  readonly content: string | Uint8Array<ArrayBuffer> | ArrayBuffer | Blob;
}

/** Where there are no elements, such as on a server that renders pages, the module can be imported all the same. */
const Base = (globalThis.HTMLElement ?? class {}) as typeof HTMLElement;

/** The element; see the manual for its attributes and events. */
export class MarrowViewer extends Base {
  static readonly observedAttributes: readonly string[] = ATTRIBUTES;

  private readonly parts: Parts;
  private readonly player = new Player((now, before) => this.showTime(now, before));
  private view: SharedView | undefined;
  private held: Held | undefined;
  private given: readonly ViewedFile[] | undefined;
  private output: OpenOutput | undefined;
  private document: Document = EMPTY_DOCUMENT;
  private isSeen = false;
  /** Something is to be drawn once it is seen. */
  private isStale = false;
  /** What attributes ask for that can't be, by their names. */
  private readonly wrong = new Map<AttributeName, string>();
  private failure = '';
  /** It plays once it is loaded, whatever `autoplay` says. */
  private isAwaited = false;
  /** Ends with its time on the page. */
  private life: AbortController | undefined;

  constructor() {
    super();
    const root = this.attachShadow({ mode: 'open' });
    adoptStyle(root);
    this.parts = new Parts(root, {
      toggle: () => this.toggle(),
      seek: (timeSeconds) => {
        this.currentTime = timeSeconds;
      },
    });
  }

  connectedCallback(): void {
    // It was moved within the page.
    if (this.life) return;
    const life = new AbortController();
    this.life = life;
    life.signal.addEventListener('abort', useWorker());
    const watching = new IntersectionObserver((entries) => this.setSeen(entries[entries.length - 1].isIntersecting));
    watching.observe(this);
    life.signal.addEventListener('abort', () => watching.disconnect());
    listenToKeys(this.parts.stage, this.keyTarget(), life.signal);
    const { signal } = life;
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.showBackground(), { signal });
    for (const name of ATTRIBUTES) this.apply(name);
  }

  disconnectedCallback(): void {
    queueMicrotask(() => {
      if (!this.isConnected) this.end();
    });
  }

  attributeChangedCallback(name: AttributeName): void {
    if (this.life) this.apply(name);
  }

  /** Seconds, as in the files: a take may begin at any. */
  get currentTime(): number {
    return this.player.playback.timeSeconds;
  }

  /** @throws TypeError for what is no time */
  set currentTime(timeSeconds: number) {
    if (!Number.isFinite(timeSeconds)) throw new TypeError(`currentTime takes seconds, not ${timeSeconds}.`);
    this.player.update((now) => ({ ...now, timeSeconds }));
  }

  /** Seconds that the takes last; NaN until they are there. */
  get duration(): number {
    const range = rangeOfTakes(this.document);
    return range ? range[1] - range[0] : Number.NaN;
  }

  /** First and last second of the takes. */
  get range(): readonly [number, number] {
    return this.player.playback.range;
  }

  get paused(): boolean {
    return !this.player.playback.playing && !this.isAwaited;
  }

  /** Names of the characters that are shown. */
  get characters(): readonly string[] {
    return this.document.characters.map(({ name }) => name);
  }

  /** Names of the takes of the first character. */
  get takes(): readonly string[] {
    return this.characterAt(0)?.takes.map(({ name }) => name) ?? [];
  }

  /** Names of the joints of the first character, in the order of `worldMatrices`. */
  get joints(): readonly string[] {
    return this.jointsOf(0);
  }

  /** Names of the joints of a character. */
  jointsOf(character: number): readonly string[] {
    return this.characterAt(character)?.skeleton?.joints.map(({ name }) => name) ?? [];
  }

  /**
   * The pose at the current time: 16 numbers per joint, column-major, in the character's own space; a copy. Empty
   * without a skeleton.
   */
  worldMatrices(character = 0): Float64Array {
    const id = this.characterAt(character)?.id;
    return (id !== undefined && this.view?.character(id)?.worldMatrices()) || new Float64Array(0);
  }

  /** Where the camera is and what it looks at, as in the attribute `camera`; empty until something is drawn. */
  get cameraNumbers(): readonly number[] {
    return this.view ? numbersOf(this.view.camera.view) : [];
  }

  /** Shows files that the page has itself, instead of those of `src`. */
  showFiles(files: readonly ViewedFile[]): void {
    this.given = files;
    if (!this.life) return;
    const given = files.map(({ name, content }) => ({ path: name, blob: new Blob([content]) }));
    this.read(() => holdGiven(given));
  }

  play(): void {
    this.isAwaited = this.held !== undefined && !this.output;
    this.player.update((now) => (Number.isNaN(this.duration) ? now : play(now)));
  }

  pause(): void {
    this.isAwaited = false;
    this.player.update((now) => pause(now, false));
  }

  private characterAt(index: number): Character | undefined {
    return this.document.characters[index];
  }

  private toggle(): void {
    if (this.paused) this.play();
    else this.pause();
  }

  private keyTarget(): KeyTarget {
    return {
      toggle: () => this.toggle(),
      turn: (azimuth, polar) => this.view?.camera.turn(azimuth, polar),
      approach: (factor) => {
        const camera = this.view?.camera;
        if (camera) camera.view = { ...camera.view, distance: camera.view.distance * factor };
      },
      frame: () => this.view?.camera.frameAll(),
      step: (frames) => this.player.update((now) => intoRange(stepFrames(now, frames))),
    };
  }

  /** Does what an attribute says. */
  private apply(name: AttributeName): void {
    this.wrong.delete(name);
    const text = this.getAttribute(name);
    const tell = (wrong: string) => void this.wrong.set(name, wrong);
    switch (name) {
      case 'src':
        this.readAddresses(addressesIn(text ?? ''));
        break;
      case 'time':
        this.showAt(numberOf(name, text, tell));
        break;
      case 'loop':
        this.player.update((now) => ({ ...now, loop: text === null ? 'once' : 'loop' }));
        break;
      case 'speed': {
        const rate = numberOf(name, text, tell) ?? 1;
        this.player.update((now) => ({ ...now, rate }));
        break;
      }
      case 'controls':
        this.parts.setControls(text !== null);
        this.parts.setTime(this.currentTime, this.range);
        break;
      case 'background':
        this.showBackground();
        break;
      case 'poster':
        this.parts.setPoster(this.output ? '' : (text ?? ''));
        break;
      case 'camera': {
        const view = cameraOf(text, tell);
        if (this.view && view) this.view.camera.view = view;
        break;
      }
      case 'alt':
        this.showName();
        break;
      case 'take':
      case 'show':
      case 'follow':
        this.showDocument();
    }
    this.showMessage();
  }

  private readAddresses(addresses: readonly string[]): void {
    if (addresses.length > 0) this.read(() => holdFiles(addresses, document.baseURI));
    // The page may have given files before it put the element into its place.
    else if (this.given) this.showFiles(this.given);
    else this.letGo();
  }

  private read(hold: () => Held): void {
    this.letGo();
    const held = hold();
    this.held = held;
    held.opened.then(
      (output) => {
        if (this.held === held) this.take(output);
      },
      (error: unknown) => {
        if (this.held === held) this.fail(sentenceOf(error), []);
      },
    );
  }

  /** Shows what was read. */
  private take(output: OpenOutput): void {
    const { characters, diagnostics } = output;
    if (characters.length > 0) {
      try {
        this.view = this.newView();
      } catch {
        this.fail(NO_WEBGL, diagnostics);
        return;
      }
      this.output = output;
      this.parts.setPoster('');
      // A view has no colours before.
      this.showBackground();
      this.showDocument();
      const range = rangeOfTakes(this.document);
      const { framesPerSecond } = output;
      this.player.update((now) => ({
        ...now,
        ...(range && { range, timeSeconds: range[0] }),
        ...(framesPerSecond !== undefined && { framesPerSecond }),
      }));
      for (const name of ['time', 'camera'] as const) this.apply(name);
      this.view.seek(this.currentTime);
      this.showName();
    }
    if (hasErrors(diagnostics) || characters.length === 0) this.fail(wordsOf(diagnostics), diagnostics);
    if (characters.length === 0) return;
    const isAsked = this.hasAttribute('autoplay') && !matchMedia('(prefers-reduced-motion: reduce)').matches;
    if (isAsked || this.isAwaited) this.play();
    this.tell('load', { message: '', diagnostics });
  }

  private newView(): SharedView {
    const inFrame = (draw: (nowMs: number) => void) => {
      const ask = oncePerFrame(draw, 'draw');
      return () => {
        if (this.isSeen) ask();
        else this.isStale = true;
      };
    };
    const drawingFailed = (error: unknown) => this.fail(`The picture can’t be drawn. ${sentenceOf(error)}`, []);
    return new SharedView(this.parts.stage, inFrame, { drawingFailed });
  }

  private display(): Display {
    const display = displayOf(this.getAttribute('show'), (wrong) => void this.wrong.set('show', wrong));
    return { ...display, followRoot: this.hasAttribute('follow') };
  }

  private showDocument(): void {
    const { output, view } = this;
    for (const name of ['take', 'show'] as const) this.wrong.delete(name);
    const display = this.display();
    if (!output || !view) return;
    const tell = (wrong: string) => void this.wrong.set('take', wrong);
    const characters = showingTake(output.characters, this.getAttribute('take'), tell);
    this.document = { ...EMPTY_DOCUMENT, characters };
    const range = rangeOfTakes(this.document);
    if (range) this.player.update((now) => intoRange({ ...now, range }));
    view.setPlayedRange(this.range);
    view.show(this.document, { characterId: characters[0].id }, display);
    view.setFloor(display.floorAtLowest ? output.floor : 0);
    if (isAnnotated(display, characters)) void this.annotate(view);
  }

  private isAnnotated = false;

  /** Names, paths and ghosts are fetched for those that show any. */
  private async annotate(view: SharedView): Promise<void> {
    if (this.isAnnotated) return;
    this.isAnnotated = true;
    const { Annotations } = await import('../view/names/annotations.ts');
    if (view === this.view) view.annotate((...parts) => new Annotations(...parts));
  }

  private showBackground(): void {
    const tell = (wrong: string) => void this.wrong.set('background', wrong);
    const { theme, isStage, colour } = backgroundOf(this.getAttribute('background'), this, tell);
    this.parts.setTheme(theme);
    this.parts.stage.style.background = colour;
    this.view?.setTheme(theme);
    this.view?.setBackground(isStage);
  }

  private showName(): void {
    const takes = this.document.characters.map(({ name, takes, shownTake }) =>
      [name, ...(takes[shownTake] ? [takes[shownTake].name] : [])].join(', '),
    );
    this.parts.setName(this.getAttribute('alt') ?? (takes.join('; ') || 'Character'));
  }

  private showAt(timeSeconds: number | undefined): void {
    if (timeSeconds !== undefined) this.player.update((now) => ({ ...now, timeSeconds }));
  }

  private showTime(now: Playback, before: Playback): void {
    const { parts, view } = this;
    parts.setPlaying(now.playing);
    parts.setTime(now.timeSeconds, now.range);
    if (now.timeSeconds !== before.timeSeconds || now.range !== before.range) {
      view?.seek(now.timeSeconds);
      this.dispatchEvent(new Event('timeupdate'));
    }
    if (now.playing === before.playing) return;
    this.dispatchEvent(new Event(now.playing ? 'play' : 'pause'));
    if (!now.playing && now.loop === 'once' && now.timeSeconds === now.range[now.rate < 0 ? 0 : 1]) {
      this.dispatchEvent(new Event('ended'));
    }
  }

  private setSeen(isSeen: boolean): void {
    this.isSeen = isSeen;
    this.player.setSeen(isSeen);
    if (!isSeen) this.view?.rest();
    else if (this.isStale) this.view?.requestRender();
    this.isStale = false;
  }

  /** Says in the place of the picture what went wrong, or under it if there is one. */
  private fail(message: string, diagnostics: readonly Diagnostic[]): void {
    this.failure = message;
    this.isAwaited &&= this.output !== undefined;
    this.showMessage();
    this.tell('error', { message, diagnostics });
  }

  private showMessage(): void {
    const wrong = [...this.wrong.values()];
    const asked = wrong.length > 0 ? `This asks for what can’t be: ${wrong.join('; ')}.` : '';
    this.parts.setMessage([this.failure, asked].filter(Boolean).join('\n'), !this.output);
  }

  private tell(name: 'load' | 'error', detail: ReadDetail): void {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }

  /** Shows nothing, and gives back what that took. */
  private letGo(): void {
    this.held?.release();
    this.held = undefined;
    this.view?.dispose();
    this.view = undefined;
    this.output = undefined;
    this.isAnnotated = false;
    this.document = EMPTY_DOCUMENT;
    this.failure = '';
    this.pause();
    const { range, timeSeconds } = DEFAULT_PLAYBACK;
    this.player.update((now) => ({ ...now, range, timeSeconds }));
  }

  private end(): void {
    this.life?.abort();
    this.life = undefined;
    this.isSeen = false;
    this.player.setSeen(false);
    this.letGo();
  }
}

const NO_WEBGL =
  'This browser gives the page no WebGL 2, which showing a character takes. Hardware acceleration may be turned off in its settings.';

/** Messages that are shown; the event has all. */
const MAX_SHOWN = 3;

function wordsOf(diagnostics: readonly Diagnostic[]): string {
  const errors = diagnostics.filter(({ severity }) => severity === 'error');
  const told = errors.length > 0 ? errors : diagnostics;
  const lines = told.slice(0, MAX_SHOWN).map(({ file, line, column, message }) => {
    const place = line > 0 ? `${file}:${line}:${column}: ` : file && `${file}: `;
    return place + message;
  });
  if (told.length > MAX_SHOWN) lines.push(`And ${told.length - MAX_SHOWN} more.`);
  return lines.join('\n') || 'There is no character in these files.';
}

function isAnnotated({ names, ghosts, trail, characterNames }: Display, characters: readonly Character[]): boolean {
  return names || ghosts || trail || (characterNames && characters.length > 1);
}

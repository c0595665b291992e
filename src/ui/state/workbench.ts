/**
 * What panels are given: the document's store, the viewport, and the page's other state. `main.ts` builds it; panels
 * know nothing of files, workers or addresses, which are passed as functions.
 */
import type { Playback } from '../../edit/playback.ts';
import type { Store } from '../../edit/store.ts';
import type { ExchangeFormat } from '../../export/formats.ts';
import type { GlbOptions } from '../../export/glb/options.ts';
import type { ExchangeReport } from '../../export/shared/report.ts';
import type { SavedKind } from '../../files/kinds.ts';
import type { UnsavedPart } from '../../files/save/saved-parts.ts';
import type { Character } from '../../model/document.ts';
import type { Viewport } from '../../view/viewport.ts';
import type { IconName } from '../widgets/icons.ts';
import type { Observable } from '../widgets/observable.ts';
import type { DumpComparison } from './dump-comparison.ts';
import type { GuideName } from './guide.ts';
import type { KeptOffer } from './kept-offer.ts';
import type { AskedManual } from './manual-link.ts';
import type { GroupName, MenuName } from './menus.ts';
import type { Messages } from './messages.ts';
import type { Offline } from './offline.ts';
import type { Pictures } from './pictures.ts';
import type { Posing } from './posing.ts';
import type { Settings } from './settings.ts';
import type { Bindable } from './shortcuts.ts';
import type { SourceFiles } from './source.ts';
import type { Timeline } from './timeline.ts';

/** The part of the viewport that the page uses, replaceable in tests. */
export type WorkbenchStage = Pick<
  Viewport,
  | 'show'
  | 'prepare'
  | 'setLook'
  | 'seek'
  | 'fitScreen'
  | 'annotate'
  | 'setTheme'
  | 'character'
  | 'requestRender'
  | 'addOverlay'
  | 'placementOf'
  | 'pickedCopy'
  | 'sizeOf'
  | 'freezeRootMotion'
  | 'vertexAt'
  | 'withDrawnSkin'
  | 'camera'
  | 'pointing'
  | 'eye'
  | 'gridStep'
  | 'setFloor'
  | 'heatSkin'
  | 'canvas'
  | 'stats'
  | 'shotParts'
>;

export interface Workbench {
  readonly store: Store;
  readonly actions: ActionList;
  readonly viewport: WorkbenchStage;
  /** The element that contains the viewport; the page places it. */
  readonly viewportElement: HTMLElement;
  readonly transport: Observable<Playback>;
  /** What the curve editor and the dope sheet show. */
  readonly timeline: Timeline;
  /** State of posing in the viewport. */
  readonly posing: Posing;
  readonly settings: Observable<Settings>;
  readonly messages: Messages;
  /** A file being loaded. */
  readonly loading: Observable<Loading | undefined>;
  /** The open dialog. */
  readonly dialog: Observable<DialogName | undefined>;
  readonly files: FileActions;
  /** Sessions left by an earlier page, on offer. */
  readonly kept: Observable<KeptOffer | undefined>;
  readonly offline: Observable<Offline>;
  /** A character compared with another program's numbers. */
  readonly comparing: Observable<DumpComparison | undefined>;
  /** The guided first steps that are shown. */
  readonly guide: Observable<GuideName | undefined>;
  /** The page of the manual that was last asked for, while the manual is in the inspector's place. */
  readonly manual: Observable<AskedManual | undefined>;
}

/**
 * A part of the workbench: a panel's type declares what it uses.
 *
 *     function takesPanel(wb: Uses<'store' | 'timeline'>): HTMLElement
 */
export type Uses<Members extends keyof Workbench> = Pick<Workbench, Members>;

/** The page's actions, which may use all of it; their callers may not. `action.ts` finds them by id. */
export interface ActionList {
  /** All current ones, in the order of the menus. */
  all(): readonly Action[];
  label(action: Action): string;
  /** Why it can't be done now, as a sentence; undefined if it can. */
  refusal(action: Action): string | undefined;
  /** Undefined if it isn't checkable. */
  checked(action: Action): boolean | 'mixed' | undefined;
  /** Returns a promise if its script is loaded first. */
  run(action: Action, args?: unknown): Promise<void> | undefined;
  /** Runs it if enabled. A refusal becomes a message, and so does the reason if it is disabled or changes nothing. */
  attempt(action: Action, args?: unknown): void;
}

/** The single record behind a menu entry, a shortcut, a line of the `?` page and a scripted call. */
export interface Action extends Bindable {
  /** Stable: `play.toggle`. */
  readonly id: string;
  readonly label: string | ((wb: Workbench) => string);
  /** Its name if the label depends on state. */
  readonly name?: string;
  /** Other words that the command search finds it by. */
  readonly also?: string;
  /** A second line in the menu. */
  readonly detail?: string;
  readonly group: GroupName;
  /** `View`, or `View/Draw` for a submenu. Absent: only shortcuts and search. */
  readonly menu?: MenuName | `${MenuName}/${string}`;
  /** A second menu that lists it, for those who look for it there. */
  readonly alsoIn?: { readonly menu: MenuName; readonly section?: number };
  /** Entries of one menu with different sections are separated by a line. */
  readonly section?: number;
  readonly icon?: IconName;
  /** Repeats while its key is held. */
  readonly repeats?: boolean;
  /** Says nothing if it is disabled or changes nothing: Escape, which may be pressed to be sure. */
  readonly quiet?: boolean;
  /** Its keys also work while a dialog is open. */
  readonly inDialogs?: boolean;
  /** What is said if it changed nothing. */
  readonly unchanged?: string;
  /** Why it can't be done now, as a sentence, told when it is tried; undefined if it can. Absent: it always can. */
  refuses?(wb: Workbench): string | undefined;
  /** Its menu shows the reason too, in place of the detail: for what would surprise. */
  explained?: boolean;
  /** Shows a check mark, or a dash for `mixed`: of some of what is selected; `radio` for alternatives. */
  checked?(wb: Workbench): boolean | 'mixed';
  readonly radio?: boolean;
  /** Returns a promise if its script is loaded first. */
  run(wb: Workbench, args?: unknown): void | Promise<void>;
}

/** How a long work continues, and how it is stopped. */
export interface ExchangeWork {
  readonly signal: AbortSignal;
  /** From 0 to 1. */
  onProgress(fraction: number): void;
}

/** What is written for another program, and how. */
export interface AskedExchange {
  readonly format: ExchangeFormat;
  readonly character: Character;
  readonly options: GlbOptions;
}

export interface MadeExchange {
  readonly bytes: Uint8Array<ArrayBuffer>;
  readonly report: ExchangeReport;
}

export type DialogName =
  | 'shortcuts'
  | 'search'
  | 'save'
  | ExchangeFormat
  | 'about'
  | 'programs'
  | 'retarget'
  | 'attach'
  | 'holdPins'
  | 'skinWeights'
  | 'outsideCycle'
  | TakeToolName
  | 'picture'
  | 'video'
  | 'markers'
  | CurveToolName;
/** The curve tools with a dialog. */
export type CurveToolName = 'simplify' | 'resample' | 'bake' | 'scaleKeys' | SampleToolName;
/** The tools for whole takes with a dialog. */
export type TakeToolName = 'checkTake' | 'loopTake' | 'lockFeet' | 'joinTakes' | 'insertTake' | 'cutOut' | 'takeSpeed';
/** Those for samples with a dialog. */
export type SampleToolName = 'convertToKeys' | 'smoothSamples' | 'resampleSamples';

export interface Loading {
  /** Name of the file being read. */
  readonly label: string;
  /** Bytes. */
  readonly done: number;
  /** 0 while unknown. */
  readonly of: number;
  cancel(): void;
}

export interface SampleEntry {
  readonly id: string;
  readonly label: string;
  readonly description: string;
}

/** Verdicts on takes in review that no list has yet. */
export interface UnsavedList {
  readonly kind: 'review';
  /** Name of the file to write. */
  readonly name: string;
  readonly characterId?: undefined;
}

/** What others can look at; `app/sharing.ts` makes it. */
export interface Sharing {
  /** Copies an address that opens what is shown, where all of it came from links or examples. */
  copyLink(): Promise<void>;
  /** What is shown, as a page in one file, which needs no network. Rejects if a character can't be written. */
  webPage(): Promise<Blob>;
  /** Downloads that. */
  saveWebPage(): Promise<void>;
}

/** The page's file operations. */
export interface FileActions {
  /** Opens the browser's file dialog. */
  open(): void;
  openFolder(): void;
  openSample(id: string): void;
  /** Downloads small files that tell known mistakes apart, with their answers, as a zip. */
  saveKit(): void;
  /** Read whenever a menu opens, so the list may arrive late. */
  readonly samples: readonly SampleEntry[];
  drop(data: DataTransfer): void;
  paste(data: DataTransfer): void;
  /** Unsaved parts, in the order of characters, and the review's list. */
  readonly unsaved: Pick<Observable<readonly (UnsavedPart | UnsavedList)[]>, 'get' | 'subscribe'>;
  /** Saves them: in place, or where the user chooses. */
  saveChanged(): void;
  /** Reloads a character's files, if they have changed on disk. */
  reload(characterId: string): void;
  canReload(characterId: string): boolean;
  /** The text of files, as they were opened. */
  readonly source: SourceFiles;
  /**
   * Saves parts of one kind to a place that the user chooses. A kind that the character doesn't have is converted:
   * skeleton and animation from motion capture, and the reverse, at the transport's frame rate.
   */
  save(characterId: string, kind: SavedKind): void;
  /** Downloads a text. */
  saveText(name: string, text: string): void;
  /** Saves a character as one zip. */
  saveAll(characterId: string): void;
  /** Downloads all characters as one zip. */
  saveEverything(): void;
  /** What makes links and pages for others; undefined, with a message, if it can't be loaded. */
  sharing(): Promise<Sharing | undefined>;
  /** What makes pictures and videos; undefined, with a message, if it can't be loaded. */
  pictures(): Promise<Pictures | undefined>;
  /** Makes a file of a character for another program, to be looked at before it is saved. Rejects if it is cancelled or fails. */
  makeExchange(asked: AskedExchange, work: ExchangeWork): Promise<MadeExchange>;
  /** Saves bytes to a place that the user chooses. */
  saveBytes(name: string, bytes: Uint8Array<ArrayBuffer>, mime: string): void;
}

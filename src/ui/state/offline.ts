/** The page as an app: stored in the browser, installed, updated. */

export interface Offline {
  /** All its files are stored, so it opens without its server. */
  readonly isReady: boolean;
  /** Stored, and on offer. */
  readonly newVersion?: NewVersion;
  /** Opens the browser's dialog; absent if it can't be installed, or is. */
  readonly install?: () => void;
}

export interface NewVersion {
  /** Answered with *Not now*: only listed in the menu. */
  readonly isPutOff: boolean;
  /** Switches to it. The browser asks first if anything is unsaved. */
  reload(): void;
  later(): void;
}

export const NOT_OFFLINE: Offline = { isReady: false };

/** Files that the system opens with the installed page (`file_handlers` in its manifest). */
import { fromHandles, type GivenFile } from './given.ts';

/** Not in TypeScript's DOM library, because not every browser has it. https://wicg.github.io/web-app-launch/ */
declare global {
  interface Window {
    readonly launchQueue?: { setConsumer(consumer: (launch: Launch) => void): void };
  }
}
interface Launch {
  /** Empty if the page was opened without files. */
  readonly files?: readonly (FileSystemFileHandle | FileSystemDirectoryHandle)[];
}

/** Calls back with the files of each launch; the browser keeps those from before. */
export function onLaunched(
  open: (files: Promise<readonly GivenFile[]>) => void,
  page: Pick<Window, 'launchQueue'>,
): void {
  page.launchQueue?.setConsumer(({ files }) => {
    if (files?.length) open(fromHandles(files));
  });
}

/** What whoever fixes an error needs to know of it. Nothing of the user's files is in it but what errors say. */
import { VERSION } from '../model/version.ts';
import type { Messages } from '../ui/state/messages.ts';
import type { FileActions } from '../ui/state/workbench.ts';
import { BLOCKED, copyText } from '../ui/widgets/clipboard.ts';

export interface ReportParts {
  readonly messages: Pick<Messages, 'note'>;
  readonly files: Pick<FileActions, 'saveText'>;
}

/** @param faults how often each came, by its text */
export function reportText(faults: ReadonlyMap<string, number>, browser: string): string {
  const told = Array.from(faults, ([text, times]) => (times > 1 ? `${times} times: ${text}` : text));
  return [`Marrow ${VERSION}, ${browser}`, ...told].join('\n\n');
}

/** Copies the report, or saves it where the browser lets nothing be copied, and says so. */
export async function copyReport({ messages, files }: ReportParts, faults: ReadonlyMap<string, number>): Promise<void> {
  const text = reportText(faults, navigator.userAgent);
  const isCopied = await copyText(text);
  if (!isCopied) files.saveText('marrow-report.txt', text);
  if (isCopied) messages.note('Report copied.');
  else messages.note(`${BLOCKED} The report was saved as a file instead.`, 'warning');
}

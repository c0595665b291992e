/** What whoever mends an error needs to know of it. Nothing of the user's files is in it but what errors say. */
import { VERSION } from '../model/version.ts';
import { copyText } from '../ui/kit/clipboard.ts';
import type { Messages } from '../ui/state/messages.ts';

/** @param faults how often each came, by its text */
export function reportText(faults: ReadonlyMap<string, number>, browser: string): string {
  const told = Array.from(faults, ([text, times]) => (times > 1 ? `${times} times: ${text}` : text));
  return [`Marrow ${VERSION}, ${browser}`, ...told].join('\n\n');
}

/** Copies the report, and says so. */
export async function copyReport(messages: Pick<Messages, 'note'>, faults: ReadonlyMap<string, number>): Promise<void> {
  const isCopied = await copyText(reportText(faults, navigator.userAgent));
  if (isCopied) messages.note('Report copied.');
  else messages.note('The browser does not let the page copy text.', 'warning');
}

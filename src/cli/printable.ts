/** Controls other than line ends and tabs, and what turns the direction of text. */
const UNPRINTABLE = /[^\P{Cc}\n\t]|[\u202a-\u202e\u2066-\u2069]/gu;

/** Names and contents of files must not control the terminal: what would is replaced by U+FFFD. */
export function printable(text: string): string {
  return text.replace(UNPRINTABLE, '\ufffd');
}

/** As `printable`, in one line: a name with a line end can't pass for a message of its own. */
export function printableLine(text: string): string {
  return printable(text).replace(/[\n\t]/g, '\ufffd');
}

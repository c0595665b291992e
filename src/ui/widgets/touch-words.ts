/** Instructions for a touch screen, which has taps and buttons instead of clicks and keys. */

/** The text with *Tap* for *Click*, and the button ◆ for K, if the main pointer is a finger. */
export function touchWords(text: string): string {
  return typeof matchMedia === 'function' && matchMedia('(pointer: coarse)').matches ? tapping(text) : text;
}

export function tapping(text: string): string {
  return text
    .replace(/\bClick\b/g, 'Tap')
    .replace(/\bclick\b/g, 'tap')
    .replace(/\bPress K\b/g, 'Tap ◆')
    .replace(/\bpress K\b/g, 'tap ◆')
    .replace(/ or Shift\+K to key the whole pose/g, '');
}

/** 0 up to `from`, 1 beyond `to`, a smooth S-curve between, as in GLSL; also with `from` greater than `to`. */
export function smoothstep(from: number, to: number, x: number): number {
  const t = Math.min(1, Math.max(0, (x - from) / (to - from)));
  return t * t * (3 - 2 * t);
}

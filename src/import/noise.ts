/**
 * Part of a length or of a factor, or radians: what differs by less is the same. Exporters compute in single precision,
 * and a track of a scale that nobody touched is 1 ± 3e-7.
 */
export const NOISE = 2e-6;

/** Files and labels have degrees; everything else has radians. */
export const RADIANS_PER_DEGREE: number = Math.PI / 180;

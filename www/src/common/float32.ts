/** The distance of 1 from the next float32: the relative rounding of what is drawn is at most half of it. */
export const FLOAT32_STEP = 2 ** -23;

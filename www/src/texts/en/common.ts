// What several parts of the page say: numbers, names of places, keys.

export const common = {
  andMore: (entries: number) => `and ${entries} more`,
  cpuFloat64: "CPU, float64",
  webGpuAndFloat64: (adapter: string) => `WebGPU${adapter} · bounds completed in float64`,
  showTheParts: "Show the parts",
  showAll: "Show all",
  esc: "Esc",
  showWhatWasSeenBefore: "Show what was seen before; end picking",
  enter: "Enter",
  pinAPointInThe: "Pin a point in the middle of the view",
  turnTheView: "Turn the view",
  doubleClick: "Double click",
  showBothModels: "Show both models",
  triangle: (triangle: number) => `triangle ${triangle}`,
  point: (index: number) => `point ${index}`,
  face: (face: number) => `face ${face}`,
  numberIn: (interval: string, interval2: string) => `${interval} in ${interval2}`,
  milliseconds: (number: string) => `${number} ms`,
  seconds: (number: string) => `${number} s`,
};

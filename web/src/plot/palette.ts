// Colours of plots and mechanisms, on light and on dark ground. All pairs of lines are told apart by people who see red and green alike.

export interface Palette {
  ground: string;
  ink: string;
  faint: string;
  grid: string;
  series: readonly string[];
  up: string;
  down: string;
  impact: string;
  stick: string;
  contact: string;
  body: string;
  edge: string;
  cursor: string;
  stable: string;
  unstable: string;
}

export const light: Palette = {
  ground: "#ffffff", ink: "#1c2733", faint: "#5b6875", grid: "#e6eaee",
  series: ["#0b63a5", "#c4500a", "#1d7f5f", "#7a4da0", "#8a6d00", "#b23a6d"],
  up: "#0b63a5", down: "#c4500a", impact: "#cf2e2e", stick: "#0f8f86", contact: "#b98900",
  body: "#d5e3ef", edge: "#33475b", cursor: "#7c8a97", stable: "#1c2733", unstable: "#b23a6d",
};

export const dark: Palette = {
  ground: "#12181f", ink: "#e7edf3", faint: "#9fb0bf", grid: "#25303b",
  series: ["#5eb1f2", "#ff9a52", "#5ad1a8", "#c39be8", "#e3c34d", "#f28cb5"],
  up: "#5eb1f2", down: "#ff9a52", impact: "#ff6b6b", stick: "#3fd0c4", contact: "#e3b93f",
  body: "#2b4257", edge: "#b4c8da", cursor: "#8294a5", stable: "#e7edf3", unstable: "#f28cb5",
};

export function isDark(): boolean {
  return document.documentElement.dataset["theme"] === "dark";
}

export function palette(): Palette {
  return isDark() ? dark : light;
}

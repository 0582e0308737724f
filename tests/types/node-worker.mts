// What the types of Node say of its workers, as far as it matters here.
export declare class Worker {
  postMessage(value: any, transferList?: readonly object[]): void;
  terminate(): Promise<number>;
}

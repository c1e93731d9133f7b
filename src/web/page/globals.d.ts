// What browsers have and older versions of TypeScript do not know.
declare const CompressionStream: any;
declare const DecompressionStream: any;
interface Navigator { userActivation?: {hasBeenActive: boolean} }

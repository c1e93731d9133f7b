// What browsers have and older versions of TypeScript do not know.
declare const AudioData: any;
declare const AudioDecoder: any;
declare const AudioEncoder: any;
declare const EncodedAudioChunk: any;
declare const CompressionStream: any;
declare const DecompressionStream: any;
interface Navigator { userActivation?: {hasBeenActive: boolean} }

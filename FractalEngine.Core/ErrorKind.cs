namespace FractalEngine.Core;

/// <summary>Why an operation of the engine failed; the exit codes of the program follow it.</summary>
public enum ErrorKind
{
    /// <summary>The input is malformed, contradicts itself, or does not fit what is asked of it.</summary>
    Input,

    /// <summary>The input is well-formed, but asks for more than a stated limit of the engine, the machine or the driver.</summary>
    Limit,

    /// <summary>Something that the operation needs is missing here, such as a display.</summary>
    Unavailable,
}

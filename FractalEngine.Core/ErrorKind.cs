namespace FractalEngine.Core;

/// <summary>
/// Why an operation of the engine failed. The exit codes of the program follow it, except that a collider which does not fit counts as
/// wrong usage.
/// </summary>
public enum ErrorKind
{
    /// <summary>The input is malformed, contradicts itself, or does not fit what is asked of it.</summary>
    Input,

    /// <summary>The input is well-formed, but asks for more than a stated limit of the engine, the machine or the driver.</summary>
    Limit,

    /// <summary>Something that the operation needs is missing here, such as a display.</summary>
    Unavailable,
}

namespace FractalEngine.Parsing.Text.Mistakes;

/// <summary>A mistake that many make in one kind of file. It is recognised where parsing failed, so that the message can name it.</summary>
internal abstract class TypicalMistake
{
    /// <summary>Explains a failure that this mistake causes.</summary>
    /// <returns>What to write instead, as one clause without a full stop; null where the text has another mistake.</returns>
    public abstract string? Explain(SyntaxFailure failure);
}

using System.Globalization;
using System.Runtime.CompilerServices;

namespace FractalEngine.Tests.Support;

/// <summary>
/// Assertions in loops. A message is made only where one fails: the text of a few numbers takes longer than most of what is checked.
/// </summary>
internal static class Ensure
{
    public static void That(bool condition, [InterpolatedStringHandlerArgument(nameof(condition))] ref Message message)
    {
        if (!condition)
        {
            Assert.Fail(message.ToText());
        }
    }

    /// <summary>A text that is left out where a condition holds.</summary>
    [InterpolatedStringHandler]
    public ref struct Message
    {
        private DefaultInterpolatedStringHandler _text;

        public Message(int literalLength, int formattedCount, bool condition, out bool isNeeded)
        {
            isNeeded = !condition;
            _text = isNeeded ? new(literalLength, formattedCount, CultureInfo.InvariantCulture) : default;
        }

        public void AppendLiteral(string value) => _text.AppendLiteral(value);

        public void AppendFormatted<T>(T value, string? format = null) => _text.AppendFormatted(value, format);

        public string ToText() => _text.ToStringAndClear();
    }
}

using System.Globalization;

namespace FractalEngine.Core.Approximation.Damaged;

/// <summary>
/// A network with one hidden layer: Σ vⱼ·s(Σ wⱼᵢ·xᵢ + bⱼ) + c, where s(x) = x/(1 + |x|) has the same bits on all machines.
/// </summary>
/// <param name="Hidden">Weights of the hidden layer, the bias of each unit last, [units, inputs + 1].</param>
/// <param name="Output">Weights of the output, its bias last, [units + 1].</param>
internal sealed record Perceptron(double[][] Hidden, double[] Output)
{
    /// <summary>Reads what <see cref="Write"/> writes: a line of numbers for each hidden unit, and one for the output.</summary>
    public static Perceptron Parse(string text)
    {
        var rows = text.Split('\n', StringSplitOptions.RemoveEmptyEntries)
            .Select(line => Array.ConvertAll(line.Split(' '), number => double.Parse(number, CultureInfo.InvariantCulture))).ToArray();
        return new(rows[..^1], rows[^1]);
    }

    /// <summary>Returns the weights as text, from which the same bits are read.</summary>
    public string Write() => string.Concat(Hidden.Append(Output).Select(
        row => string.Join(' ', row.Select(weight => weight.ToString("R", CultureInfo.InvariantCulture))) + "\n"));

    /// <summary>Computes what the hidden units give, and the output.</summary>
    /// <param name="inputs">The inputs.</param>
    /// <param name="units">Receives what the hidden units give, [units].</param>
    public double Evaluate(ReadOnlySpan<double> inputs, Span<double> units)
    {
        var output = Output[^1];
        for (var unit = 0; unit < units.Length; unit++)
        {
            var sum = Hidden[unit][^1];
            for (var input = 0; input < inputs.Length; input++)
            {
                sum += Hidden[unit][input] * inputs[input];
            }

            units[unit] = sum / (1 + Math.Abs(sum));
            output += Output[unit] * units[unit];
        }

        return output;
    }
}

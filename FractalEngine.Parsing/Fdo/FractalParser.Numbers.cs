using System.Collections.Immutable;
using System.Globalization;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Numbers;

namespace FractalEngine.Parsing.Fdo;

/// <content>Lists the numbers of a file with their places, for programs that turn them.</content>
public sealed partial class FractalParser
{
    // In the order of the outputs of a transformation function.
    private static readonly FractalNumberRole[] OutputRoles =
        [FractalNumberRole.Position, FractalNumberRole.Rotation, FractalNumberRole.Scale];

    // Null while numbers are not listed, which costs nothing then.
    private List<FractalNumber>? _numbers;
    private Dictionary<int, FractalNumberRole>? _vectorRoles;
    private int _outputCount;
    private int _callCount;
    private int _setCount;
    private int _callIndex;

    /// <summary>Parses a file, and lists its numbers.</summary>
    internal static ImmutableArray<FractalNumber> FindNumbers(SourceText source)
    {
        var parser = new FractalParser(source) { _numbers = [], _vectorRoles = [] };
        parser.ParseFile();
        return
        [
            .. parser._numbers.Select(number => number.Role is FractalNumberRole.Depth or FractalNumberRole.Argument ? number
                : number with
                {
                    Role = parser._vectorRoles.GetValueOrDefault(VectorNumber(number), FractalNumberRole.Vector),
                }),
        ];
    }

    private static int VectorNumber(FractalNumber number) =>
        int.Parse(number.Name.AsSpan(1), CultureInfo.InvariantCulture);

    /// <summary>Lists the components of the vector that was declared last.</summary>
    private void ListVector(Cursor start, Cursor end)
    {
        var position = start.Offset;
        for (var component = 0; component < 3 && _numbers is not null; component++)
        {
            while (Source.Text[position] is ' ' or '\t' or ',')
            {
                position++;
            }

            NumberReader.TryRead(Source.Text.AsSpan(position, end.Offset - position), out var value, out var length);
            _numbers.Add(new(
                FractalNumberRole.Vector, FormattableString.Invariant($"v{_vectors.Count}"), component, position, length, value));
            position += length;
        }
    }

    private void ListDepth(string name, Cursor start, Cursor end, int depth) =>
        _numbers?.Add(new(FractalNumberRole.Depth, name, 0, start.Offset, end.Offset - start.Offset, depth));

    /// <summary>Lists an argument of a call, and records what its vector means by what the function makes of it.</summary>
    private void ListArgument(string name, Cursor start, Cursor end, int vector, int index, TransformationFunction function)
    {
        if (_vectorRoles is null || index >= function.ParameterCount)
        {
            return;
        }

        _callCount += index == 0 ? 1 : 0;
        _numbers!.Add(new(
            FractalNumberRole.Argument, FormattableString.Invariant($"{name} {_callCount}"), index, start.Offset,
            end.Offset - start.Offset, vector)
        {
            Call = (_setCount, _callIndex, 0),
        });

        ReadOnlySpan<FunctionOutput> outputs = [function.Position, function.Rotation, function.Scale];
        for (var output = 0; output < outputs.Length; output++)
        {
            if (outputs[output].Parameter == index)
            {
                AddRole(vector, OutputRoles[output]);
            }
        }
    }

    /// <summary>Completes what is listed of the arguments of a set.</summary>
    /// <param name="size">Number of entries of the set.</param>
    private void ListSet(int size)
    {
        for (var i = (_numbers?.Count ?? 0) - 1; i >= 0 && _numbers![i].Call is { SetSize: 0 } call; i--)
        {
            _numbers[i] = _numbers[i] with { Call = call with { SetSize = size } };
        }

        _setCount++;
    }

    /// <summary>Records what a vector means that a function uses itself.</summary>
    private void ListOutput(int vector) => AddRole(vector, OutputRoles[Math.Min(_outputCount, OutputRoles.Length - 1)]);

    private void AddRole(int vector, FractalNumberRole role)
    {
        if (_vectorRoles is { } roles)
        {
            roles[vector] = roles.TryGetValue(vector, out var known) && known != role ? FractalNumberRole.Vector : role;
        }
    }
}

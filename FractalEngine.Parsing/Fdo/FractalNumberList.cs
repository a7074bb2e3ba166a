using System.Collections.Immutable;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Numbers;

namespace FractalEngine.Parsing.Fdo;

/// <summary>Lists the numbers of a fractal file with their places, for programs that turn them.</summary>
internal sealed class FractalNumberList
{
    private readonly List<FractalNumber> _numbers = [];
    private readonly Dictionary<string, FractalNumberRole> _vectorRoles = [];
    private int _callCount;
    private int _setCount;

    /// <summary>Returns the numbers of a file that was parsed whole: only then it is known what its vectors mean.</summary>
    public ImmutableArray<FractalNumber> Complete() =>
    [
        .. _numbers.Select(number => number.Role != FractalNumberRole.Vector ? number
            : number with { Role = _vectorRoles.GetValueOrDefault(number.Name, FractalNumberRole.Vector) }),
    ];

    /// <summary>Name of a vector that has a number only.</summary>
    public static string NameOf(int vector) => FormattableString.Invariant($"v{vector}");

    /// <summary>Lists the components of a vector.</summary>
    /// <param name="vector">Number of the vector, from 1.</param>
    /// <param name="start">Position of its first number.</param>
    /// <param name="end">Position behind its last.</param>
    public void AddVector(int vector, Cursor start, Cursor end)
    {
        for (var component = 0; component < 3; component++)
        {
            while (start.Current is ' ' or '\t' or ',')
            {
                start = start.Advance(1);
            }

            NumberReader.TryRead(start.Rest[..(end.Offset - start.Offset)], out var value, out var length);
            _numbers.Add(new(FractalNumberRole.Vector, NameOf(vector), component, start.Offset, length, value) { Vector = vector });
            start = start.Advance(length);
        }
    }

    /// <summary>Lists a component of a vector that stands in parentheses.</summary>
    /// <param name="name">Name of the vector, or of the function that has it as an output.</param>
    /// <param name="component">From 0 to 2 for x, y and z.</param>
    /// <param name="start">Position of the number.</param>
    /// <param name="end">Position behind it.</param>
    /// <param name="value">The number.</param>
    /// <param name="role">What it means; null for what the file makes of the named vector.</param>
    /// <param name="isEven">True where all components are this number.</param>
    public void AddComponent(string name, int component, Cursor start, Cursor end, double value, FractalNumberRole? role, bool isEven) =>
        _numbers.Add(new(role ?? FractalNumberRole.Vector, name, component, start.Offset, end.Offset - start.Offset, value)
        {
            IsEven = isEven,
        });

    /// <summary>Lists a number that the file gives a name.</summary>
    /// <param name="name">The name.</param>
    /// <param name="start">Position of its expression.</param>
    /// <param name="end">Position behind that.</param>
    /// <param name="value">The value of the expression.</param>
    /// <param name="range">Ends of its slider; null where the file has none.</param>
    public void AddNamed(string name, Cursor start, Cursor end, double value, (double From, double To)? range) =>
        _numbers.Add(new(FractalNumberRole.Named, name, 0, start.Offset, end.Offset - start.Offset, value) { Range = range });

    /// <summary>Lists the depth of a recursive.</summary>
    public void AddDepth(string name, Cursor start, Cursor end, int depth) =>
        _numbers.Add(new(FractalNumberRole.Depth, name, 0, start.Offset, end.Offset - start.Offset, depth));

    /// <summary>Lists an argument of a call, and records what its vector means by what the function makes of it.</summary>
    /// <param name="name">Name of the function.</param>
    /// <param name="start">Position of the argument.</param>
    /// <param name="end">Position behind it.</param>
    /// <param name="vector">The argument: the number of a vector.</param>
    /// <param name="index">Number of arguments before it.</param>
    /// <param name="function">The function, which has too few parameters where the call is wrong.</param>
    /// <param name="callIndex">Number of maps before that of the call in its set.</param>
    /// <param name="isFirst">True for the first argument of the call that is listed.</param>
    public void AddArgument(
        string name, Cursor start, Cursor end, int vector, int index, TransformationFunction function, int callIndex, bool isFirst)
    {
        if (index >= function.Parameters.Count)
        {
            return;
        }

        _callCount += isFirst ? 1 : 0;
        var callName = FormattableString.Invariant($"{name} {_callCount}");
        var number = new FractalNumber(FractalNumberRole.Argument, callName, index, start.Offset, end.Offset - start.Offset, vector);
        _numbers.Add(number with { Call = (_setCount, callIndex, 0) });
        AddRoles(NameOf(vector), index, function);
    }

    /// <summary>Records what a vector means that is an argument.</summary>
    public void AddRoles(string vector, int index, TransformationFunction function)
    {
        foreach (var (output, role) in function.Outputs)
        {
            if (output.Parameter == index)
            {
                AddRole(vector, role);
            }
        }
    }

    /// <summary>Completes what is listed of the arguments of a set.</summary>
    /// <param name="size">Number of maps of the set.</param>
    public void EndSet(int size)
    {
        for (var i = _numbers.Count - 1; i >= 0 && _numbers[i].Call is { SetSize: 0 } call; i--)
        {
            _numbers[i] = _numbers[i] with { Call = call with { SetSize = size } };
        }

        _setCount++;
    }

    /// <summary>Records what a vector means that a function uses itself.</summary>
    public void AddRole(string vector, FractalNumberRole role) =>
        _vectorRoles[vector] = _vectorRoles.TryGetValue(vector, out var known) && known != role ? FractalNumberRole.Vector : role;
}

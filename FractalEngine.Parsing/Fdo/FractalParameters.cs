namespace FractalEngine.Parsing.Fdo;

/// <summary>The parameters of a transformation function. Each is a number or a vector by its use.</summary>
/// <param name="names">Their names, in order.</param>
internal sealed class FractalParameters(List<string> names)
{
    /// <summary>No parameters, as everywhere outside of functions.</summary>
    public static readonly FractalParameters None = new([]);

    private readonly bool?[] _areNumbers = new bool?[names.Count];

    /// <summary>Number of parameters, from 0 to 3.</summary>
    public int Count { get; } = names.Count;

    /// <summary>Returns the index of a parameter, or −1.</summary>
    public int IndexOf(string name) => names.IndexOf(name);

    /// <summary>Name of a parameter, as the function declares it.</summary>
    public string NameOf(int index) => names[index];

    /// <summary>True for a parameter that is a number, false for a vector; null where nothing uses it.</summary>
    public bool? IsNumber(int index) => _areNumbers[index];

    /// <summary>Records a use; false where another one was different.</summary>
    public bool TryUse(int index, bool asNumber) => (_areNumbers[index] ??= asNumber) == asNumber;
}

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>One model with one damage, which is made when it is asked for.</summary>
/// <param name="Name">Kind, seed and damage, for tables.</param>
/// <param name="Damage">What is done to the model.</param>
/// <param name="Seed">The seed of the damage.</param>
/// <param name="CreateUndamaged">Makes the model; the same one each time.</param>
internal sealed record UnseenCase(string Name, Damage Damage, int Seed, Func<UnseenInput> CreateUndamaged)
{
    /// <summary>Makes the damaged model; null where the damage changes nothing, or leaves too little of it.</summary>
    public UnseenInput? Create()
    {
        var input = CreateUndamaged();
        return Damage.IsMeaningful(input) ? Damage.Apply(input, Seed) : null;
    }
}

namespace FractalEngine.Core.Physics.Rows;

/// <summary>Numbers of rounds that solves of contacts may take. A solve that has not converged by then ends with what it has.</summary>
internal static class RoundLimits
{
    /// <summary>Rounds of a solve of few contacts.</summary>
    public const int Many = 250;

    /// <summary>Rounds of a solve before it is known what bodies may meet in the step, which ends what this one leaves.</summary>
    public const int First = 32;

    // More contacts may take as many rounds as solve so many, and at least a few.
    private const int MaxContactsOfMany = 500;
    private const int MaxContactSolves = 60_000;
    private const int Min = 12;

    /// <summary>Rounds of a solve that should converge in its step.</summary>
    /// <param name="contacts">Number of contacts.</param>
    /// <param name="maxRounds">Rounds for few of them.</param>
    public static int For(int contacts, int maxRounds = Many) => contacts <= MaxContactsOfMany ? maxRounds
        : Math.Min(maxRounds, Math.Max(Min, MaxContactSolves / contacts));
}

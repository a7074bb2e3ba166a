namespace FractalEngine.Tests.App.Window.Interactions;

/// <summary>Each interaction of the table, in a window of its own that real X events drive.</summary>
[Collection(DrivenWindow.Collection)]
public class InteractionTests
{
    public static TheoryData<string> Some => [.. InteractionTable.Default];

    public static TheoryData<string> Others => [.. InteractionTable.All.Select(static row => row.Name).Except(InteractionTable.Default)];

    [SkippableTheory]
    [MemberData(nameof(Some))]
    public void Interaction_OfTheTable_HasItsEffect(string name) => Run(name);

    [SkippableTheory]
    [MemberData(nameof(Others))]
    [Trait("Category", "Soak")]
    public void Interaction_OfTheSoak_HasItsEffect(string name) => Run(name);

    [Fact]
    public void Table_HasNamesOnce_AndThoseOfTheDefaultRun()
    {
        var names = InteractionTable.All.Select(static row => row.Name).ToArray();
        Assert.Equal(names.Length, names.Distinct().Count());
        Assert.Empty(InteractionTable.Default.Except(names));
    }

    private static void Run(string name)
    {
        var interaction = InteractionTable.All.Single(row => row.Name == name);
        using var scenario = new Scenario(interaction);
        foreach (var step in interaction.Events.Concat(interaction.Expectations))
        {
            step(scenario);
        }

        scenario.Close();
    }
}

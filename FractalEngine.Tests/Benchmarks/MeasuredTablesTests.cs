using FractalEngine.Benchmarks.Colliders;
using FractalEngine.Benchmarks.Drawing;
using FractalEngine.Benchmarks.Light;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Benchmarks.Physics;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Benchmarks;

/// <summary>Tests that the measurements kept with the project say how they were made, and can be read.</summary>
public class MeasuredTablesTests
{
    private static readonly string Folder = Repository.Full("docs/benchmarks");

    public static TheoryData<string> Tables =>
        [.. Directory.GetFiles(Folder, "*.csv").Select(file => Path.GetFileName(file)).Order(StringComparer.Ordinal)];

    /// <summary>Tables with columns other than their command writes today are older than it.</summary>
    public static TheoryData<string, string[]> TablesOfCommands => new()
    {
        { "front.csv", ParetoFrontTable.Columns },
        { "frames.csv", FrameTable.Columns },
        { "skips.csv", OptimisationTable.Columns },
        { "light.csv", LightCommand.Columns },
        { "occlusion.csv", OcclusionTable.Columns },
        { "lamps.csv", LampTable.Columns },
        { "furnace.csv", FurnaceTable.Columns },
        { "shimmer.csv", ShimmerTable.Columns },
        { "fog.csv", FogTable.Columns },
        { "physics.csv", PhysicsTable.Columns },
        { "physics-heaps.csv", HeapTable.Columns },
        { "physics-movers.csv", MoverTable.Columns },
    };

    [Theory]
    [MemberData(nameof(TablesOfCommands))]
    public void Table_HasTheColumnsOfItsCommand(string file, string[] columns) =>
        Assert.Equal(columns, ParsedCsv.Read(Path.Combine(Folder, file)).Header
            .Where(column => !column.EndsWith(MergeCommand.SpreadColumnEnd, StringComparison.Ordinal)));

    [Theory]
    [MemberData(nameof(Tables))]
    public void Table_StatesCommandAndMachineAndHasWholeRows(string file)
    {
        var table = ParsedCsv.Read(Path.Combine(Folder, file));
        Assert.Equal(2, table.Comments.Length);
        Assert.Matches("^# ([a-z]+|--filter [^ ]+)( |$)", table.Comments[0]);
        Assert.Matches(@"^# \w+, \d+ cores, \.NET [^,]+, commit [0-9a-f]{7,40}(, .+)?$", table.Comments[1]);
        Assert.NotEmpty(table.Rows);
        Assert.All(table.Rows, row => Assert.Equal(table.Header.Length, row.Length));
    }
}

using FractalEngine.Tests.Recorded;

namespace FractalEngine.Tests.App.Commands;

/// <summary>As <see cref="RecordedCommandTests"/>, of processes.</summary>
public sealed class RecordedProcessTests : IDisposable
{
    private readonly Transcript _transcript = new();

    public RecordedProcessTests() => RecordedCommandTests.WriteFiles(_transcript.Folder);

    public void Dispose() => _transcript.Dispose();

    /// <summary>A walk whose steps turn has more parts around a position than any search visits.</summary>
    [Fact]
    public void Query_BeyondTheLimitOfWork_SaysHowManyAnswersAreUncertain() => Check(
        "commands-uncertain.txt",
        "$APP query walk.fdo --points one.txt",
        "$APP query walk.fdo --points one.txt --collider simple");

    /// <summary>What only a process has: its standard streams, its culture and the name by which it was called.</summary>
    [Fact]
    public void Streams_OfProcesses_AreAsRecorded() => Check(
        "commands-streams.txt",
        "$APP export row.fdo -o - --depth 1 --verbose", "$APP simulate drop.sdo --seconds 0.05",
        "$APP save scene.sdo -o - | $APP save - -o -",
        "$APP query row.fdo --points - < points.txt", "$APP query - --rays rays.txt < row.fdo",
        "$APP query /dev/stdin --points - < points.txt",
        "$APP info - <&-", "$APP check - < faulty.fdo", "$APP info - --limit description-bytes=9 < row.fdo",
        "LC_ALL=de_DE.UTF-8 $APP render --help --json | tail -5",
        "LC_ALL=de_DE.UTF-8 $APP query row.fdo --points points.txt --header", "FRACTALENGINE_PROGRAM=./run.sh $APP limits --help",
        "FRACTALENGINE_PROGRAM= $APP info -x",
        "$APP generate icosphere --faces 20 -o - | head -3",
        "mkdir gone; cd gone; rmdir ../gone; $APP info ../cube.obj; $APP export ../cube.obj -o x.obj");

    private void Check(string file, params string[] lines)
    {
        foreach (string line in lines)
        {
            _transcript.RunShell(line);
        }

        RecordedText.Check(file, _transcript.Lines);
    }
}
